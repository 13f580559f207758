#include "base/toml_section.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/input_error.h"

namespace strainwave {

namespace {

const toml::table& empty_table() {
  static const toml::table table;
  return table;
}

std::string value_text(const toml::node& node) {
  std::ostringstream text;
  node.visit([&](const auto& value) { text << value; });
  return text.str();
}

std::string number_text(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string join(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "\"" : ", \"") + word + "\"";
  return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0U : 1U)});
      diagonal = above;
    }
  }
  return row[b.size()];
}

}  // namespace

TomlSection::TomlSection(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

std::string TomlSection::full_name(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

void TomlSection::fail(std::string_view key, const std::string& allowed) const {
  const toml::node* node = table_->get(key);
  const auto line = node != nullptr ? node->source().begin.line : table_->source().begin.line;
  const std::string where = file_ + ":" + std::to_string(line);
  if (node == nullptr) throw InputError(where + ": " + full_name(key) + " is missing: " + allowed);
  throw InputError(where, full_name(key), value_text(*node), allowed);
}

const toml::node* TomlSection::find(std::string_view key) {
  asked_.emplace(key);
  return table_->get(key);
}

const toml::node& TomlSection::require(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) fail(key, "the key is required");
  return *node;
}

double TomlSection::checked(std::string_view key, const toml::node& node, Range allowed) const {
  const std::string range =
      "a number from " + number_text(allowed.min) + " to " + number_text(allowed.max) + " is allowed";
  const auto value = node.value<double>();
  if (!node.is_number() || !value || !std::isfinite(*value) || *value < allowed.min || *value > allowed.max)
    fail(key, range);
  return *value;
}

double TomlSection::number(std::string_view key, Range allowed) {
  return checked(key, require(key), allowed);
}

double TomlSection::number_or(std::string_view key, double fallback, Range allowed) {
  const toml::node* node = find(key);
  return node == nullptr ? fallback : checked(key, *node, allowed);
}

std::int64_t TomlSection::integer(std::string_view key, std::int64_t min, std::int64_t max) {
  (void)require(key);
  return integer_or(key, min, min, max);
}

std::int64_t TomlSection::integer_or(std::string_view key, std::int64_t fallback, std::int64_t min,
                                     std::int64_t max) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const auto value = node->is_integer() ? node->value<std::int64_t>() : std::nullopt;
  if (!value || *value < min || *value > max)
    fail(key, "a whole number from " + std::to_string(min) + " to " + std::to_string(max) + " is allowed");
  return *value;
}

bool TomlSection::boolean_or(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (!node->is_boolean()) fail(key, "true or false is allowed");
  return *node->value<bool>();
}

std::string TomlSection::text(std::string_view key) {
  const toml::node& node = require(key);
  if (!node.is_string()) fail(key, "a text in quotes is allowed");
  return *node.value<std::string>();
}

std::string TomlSection::text_or(std::string_view key, std::string fallback) {
  return find(key) == nullptr ? fallback : text(key);
}

std::string TomlSection::choice(std::string_view key, const std::vector<std::string>& allowed) {
  std::string value = text(key);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end())
    fail(key, "allowed are " + join(allowed));
  return value;
}

std::string TomlSection::choice_or(std::string_view key, std::string fallback,
                                   const std::vector<std::string>& allowed) {
  return find(key) == nullptr ? fallback : choice(key, allowed);
}

std::vector<double> TomlSection::numbers(std::string_view key, Range allowed) {
  const toml::array* array = require(key).as_array();
  if (array == nullptr || array->empty()) fail(key, "a list of numbers is allowed");
  std::vector<double> values;
  for (const toml::node& node : *array) values.push_back(checked(key, node, allowed));
  return values;
}

TomlSection TomlSection::section(std::string_view key) {
  const toml::table* table = require(key).as_table();
  if (table == nullptr) fail(key, "a table, written [" + full_name(key) + "], is allowed");
  return {*table, file_, full_name(key)};
}

TomlSection TomlSection::section_or_empty(std::string_view key) {
  return find(key) == nullptr ? TomlSection(empty_table(), file_, full_name(key)) : section(key);
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) {
  const toml::array* array = require(key).as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous(toml::node_type::table))
    fail(key, "one or more tables, each written [[" + full_name(key) + "]], are allowed");
  std::vector<TomlSection> result;
  for (const toml::node& node : *array)
    result.emplace_back(*node.as_table(), file_, full_name(key) + "[" + std::to_string(result.size()) + "]");
  return result;
}

void TomlSection::refuse_unknown_keys() const {
  for (const auto& [key, node] : *table_) {
    const std::string_view name = key.str();
    if (asked_.find(name) != asked_.end()) continue;
    const std::string* nearest = nullptr;
    for (const std::string& known : asked_) {
      // A forgotten unit ("period" for "period_s") is the likeliest slip; then a misspelling.
      const bool unit_forgotten = known.size() > name.size() && known.rfind(std::string(name) + "_", 0) == 0;
      if (unit_forgotten || edit_distance(name, known) <= 2) nearest = &known;
      if (unit_forgotten) break;
    }
    std::string hint = nearest != nullptr ? "did you mean " + *nearest + "?" : "known here are: ";
    if (nearest == nullptr)
      for (const std::string& known : asked_) hint += (known == *asked_.begin() ? "" : ", ") + known;
    fail(name, "unknown key; " + hint + " Physical quantities carry their unit in the key.");
  }
}

}  // namespace strainwave
