// Strict reading of one TOML table: every key is asked for by name, with its allowed range, and what nobody asked for is
// an error. Not real-time.
#pragma once

#include <toml++/toml.h>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

struct Range {
  double min;
  double max;
};

/// One table of the file. `path` is how messages name it ("joint[0].limits"). All methods throw InputError that names the
/// file, line, key, value and what is allowed.
class TomlSection {
 public:
  TomlSection(const toml::table& table, std::string file, std::string path);

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

  bool has(std::string_view key) const { return table_->contains(key); }
  /// A sub-table that must exist, or an empty one when it does not.
  TomlSection section(std::string_view key);
  TomlSection section_or_empty(std::string_view key);
  /// An array of tables, at least one.
  std::vector<TomlSection> sections(std::string_view key);

  /// Throws when the table has a key that was never asked for, with the nearest known key as a suggestion.
  void refuse_unknown_keys() const;

  /// How messages name `key`: "joint[0].limits.torque_Nm".
  std::string full_name(std::string_view key) const;
  /// An InputError about `key` of this table.
  [[noreturn]] void fail(std::string_view key, const std::string& allowed) const;

 private:
  const toml::node* find(std::string_view key);
  const toml::node& require(std::string_view key);
  double checked(std::string_view key, const toml::node& node, Range allowed) const;

  const toml::table* table_;
  std::string file_;
  std::string path_;
  std::set<std::string, std::less<>> asked_;
};

}  // namespace strainwave
