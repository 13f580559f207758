// SPDX-License-Identifier: BSD-3-Clause
// Strict reading of one TOML table: every key is asked for by name, with its allowed range, and a key that
// was not read is an error. Only this reader uses toml++. Not real-time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/number_range.h"

namespace strainwave {

/// One table of a file. Messages name it by its path ("joint[0].limits"). All methods throw InputError that names the file,
/// line, key, value and what is allowed. For a missing key, the error suggests the nearest unread key. After collect_errors(), the reader
/// notes an invalid value and returns an allowed one in its place, so that all errors of a file are reported at once.
class TomlSection {
 public:
  /// The outermost table of `text`; `file` is named in messages.
  static TomlSection parse(std::string_view text, const std::string& file);
  static TomlSection read(const std::filesystem::path& path);

  double number(std::string_view key, Range allowed);
  double number_or(std::string_view key, double fallback, Range allowed);
  std::int64_t integer(std::string_view key, std::int64_t min, std::int64_t max);
  std::int64_t integer_or(std::string_view key, std::int64_t fallback, std::int64_t min, std::int64_t max);
  bool boolean_or(std::string_view key, bool fallback);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  /// One of `allowed`.
  std::string choice(std::string_view key, const std::vector<std::string>& allowed);
  std::string choice_or(std::string_view key, std::string fallback, const std::vector<std::string>& allowed);
  std::vector<double> numbers(std::string_view key, Range allowed);

  bool has(std::string_view key) const;
  /// A sub-table. section() requires it; section_or_empty() returns an empty one if it is missing.
  TomlSection section(std::string_view key);
  TomlSection section_or_empty(std::string_view key);
  /// An array of tables, at least one.
  std::vector<TomlSection> sections(std::string_view key);

  /// Throws when the table has a key that was never asked for, with the nearest known key as a suggestion.
  void refuse_unknown_keys() const;

  /// Collects errors from now on, for every table of the file. throw_errors() must follow.
  void collect_errors();
  /// Notes an error that stopped the reading of a part of the file, unless an error, the possible cause, is already noted.
  void note_error(const std::string& error);
  /// Throws an InputError with a line for each error, if there are any.
  void throw_errors() const;

  /// How messages name `key`: "joint[0].limits.torque_limit_Nm".
  std::string full_name(std::string_view key) const;
  /// Location and value of `key` in this table: "arm.toml:12: joint[0].inertia_kgm2 = -1".
  std::string place(std::string_view key) const;
  /// Throws an InputError about `key` of this table, or with the errors that were noted before.
  [[noreturn]] void fail(std::string_view key, const std::string& allowed) const;
  /// Notes a warning about the value of `key`, which is allowed but rarely intended.
  void warn(std::string_view key, const std::string& doubt) const;
  /// The warnings about all tables of the file, in the order in which they were noted.
  const std::vector<std::string>& warnings() const;

 private:
  struct Document;
  struct Table;  ///< toml++'s table, kept with its document
  struct Reader;
  TomlSection(std::shared_ptr<const Table> table, std::string file, std::string path);
  /// Throws an InputError, or notes it after collect_errors().
  void refuse(std::string_view key, const std::string& allowed) const;
  std::string joined_errors() const;

  std::shared_ptr<const Table> table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace strainwave
