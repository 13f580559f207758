// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of JSON, shared by the files of this project. Not real-time. Every complaint is an
// InputError that names the file or message, the key and what is allowed; repeated, unknown and missing keys are errors.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// Default limit of a name, path or sentence in a file of the project.
inline constexpr std::size_t kMaxTextBytes = 4096;

/// Parses `text`; malformed JSON and repeated keys are errors. `source` is named in messages.
nlohmann::ordered_json parse_strict_json(std::string_view text, const std::string& source);

/// One object that is read key by key, then finish()ed: keys that were not read are errors. Refers to the
/// parsed document, which must outlive it.
class StrictObject {
 public:
  StrictObject(const nlohmann::ordered_json& value, const std::string& source, const std::string& path = "");

  bool has(const std::string& key) const;
  double number(const std::string& key);
  long long integer(const std::string& key);
  bool boolean(const std::string& key);
  /// At most `max_bytes` bytes.
  std::string text(const std::string& key, std::size_t max_bytes);
  StrictObject object(const std::string& key);
  /// An array of objects with `min` to `max` elements.
  std::vector<StrictObject> objects(const std::string& key, std::size_t min, std::size_t max);
  /// An array of exactly `size` numbers.
  std::vector<double> numbers(const std::string& key, std::size_t size);
  /// An array of any number of numbers.
  std::vector<double> numbers(const std::string& key);
  /// An array of `rows` arrays of `columns` numbers, row by row.
  std::vector<double> matrix(const std::string& key, std::size_t rows, std::size_t columns);

  /// Accepts a key without reading it.
  void ignore(const std::string& key) { read_.insert(key); }
  void finish() const;
  /// "path.key", or "path.key[index]" for an entry of a list.
  std::string path_of(const std::string& key) const;
  std::string path_of(const std::string& key, std::size_t index) const;
  /// "source: path.key", the beginning of messages. shown() adds " = value", unless the value is an object.
  std::string where(const std::string& key) const;
  std::string shown(const std::string& key) const;
  /// "source: path.key = value: must be `allowed`".
  [[noreturn]] void complain(const std::string& key, const std::string& allowed) const;

 private:
  const nlohmann::ordered_json& get(const std::string& key);

  const nlohmann::ordered_json* value_;
  std::string source_;
  std::string path_;
  std::set<std::string> read_;
};

}  // namespace strainwave
