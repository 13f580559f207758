// SPDX-License-Identifier: BSD-3-Clause
#include "base/toml_section.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "base/toml_nesting.h"

namespace strainwave {

namespace {

std::string value_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return "\"" + printable(text->get()) + "\"";
  if (const auto* number = node.as_floating_point()) return number_text(number->get());
  if (const auto* whole = node.as_integer()) return std::to_string(whole->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  if (node.is_table()) return "(a table)";
  if (const auto* array = node.as_array()) return "(a list of " + std::to_string(array->size()) + ")";
  return "(a date or a time)";
}

std::string join(const std::vector<std::string>& words, const char* quote) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + (quote + word + quote);
  return text;
}

/// Whether this line, counted from 1, has a decimal comma, such as "key = 0,089".
bool has_decimal_comma(std::string_view text, unsigned line) {
  for (; line > 1 && !text.empty(); --line)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  text = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(text.find('='), text.size()));
  text = text.substr(0, text.find_first_of("\"'[#"));
  const std::size_t comma = text.find(',');
  const auto digit = [&](std::size_t at) { return at < text.size() && text[at] >= '0' && text[at] <= '9'; };
  return comma != std::string_view::npos && comma > 0 && digit(comma - 1) && digit(comma + 1);
}

}  // namespace

/// A file's outermost table, and the warnings and errors about the file.
struct TomlSection::Document {
  toml::table root;
  std::vector<std::string> warnings;
  std::vector<std::string> errors;
  bool collects = false;
};

struct TomlSection::Table {
  std::shared_ptr<Document> document;
  const toml::table* table;

  unsigned line() const { return static_cast<unsigned>(table->source().begin.line); }
};

/// Functions with toml++'s nodes, which the header does not declare.
struct TomlSection::Reader {
  static const toml::node* find(TomlSection& section, std::string_view key) {
    section.asked_.emplace(key);
    return section.table_->table->get(key);
  }

  /// Null if the key is missing, which is noted or thrown.
  static const toml::node* require(TomlSection& section, std::string_view key,
                                   const std::string& what = "the key") {
    const toml::node* node = find(section, key);
    if (node == nullptr) section.refuse(key, what + " is required" + instead(section, key));
    return node;
  }

  /// Suggests an unread key of the table for the missing one. refuse_unknown_keys() then accepts the suggested key.
  static std::string instead(TomlSection& section, std::string_view key) {
    std::vector<std::string> others;
    for (const auto& [name, node] : *section.table_->table)
      if (!section.asked_.contains(name.str())) others.emplace_back(name.str());
    const std::string* nearest = nearest_word(key, others);
    if (nearest == nullptr) return "";
    section.asked_.insert(*nearest);
    const auto line = section.table_->table->get(*nearest)->source().begin.line;
    return "; line " + std::to_string(line) + " has " + printable(*nearest) + ": is that what was meant?" +
           unit_conversion(*nearest);
  }

  static double checked(const TomlSection& section, std::string_view key, const toml::node& node,
                        Range allowed) {
    const auto value = node.value<double>();
    const bool is_number = node.is_number() && value && std::isfinite(*value);
    if (is_number && allowed.holds(*value)) return *value;
    section.refuse(
        key, "a number " + allowed.text() + " is allowed" + (node.is_string() ? ", without quotes" : ""));
    return is_number ? std::clamp(*value, allowed.min, allowed.max) : allowed.min;
  }
};

TomlSection::TomlSection(std::shared_ptr<const Table> table, std::string file, std::string path)
    : table_(std::move(table)), file_(std::move(file)), path_(std::move(path)) {}

TomlSection TomlSection::parse(std::string_view text, const std::string& file) {
  refuse_deep_nesting(text, file);
  try {
    const auto document = std::make_shared<Document>(Document{toml::parse(text, file), {}, {}});
    return {std::make_shared<const Table>(Table{document, &document->root}), file, ""};
  } catch (const toml::parse_error& error) {
    const auto line = error.source().begin.line;
    throw InputError(file + ":" + std::to_string(line) + ": not valid TOML: " +
                     (has_decimal_comma(text, line)
                          ? "a comma in a number: TOML has a decimal point (0.5, not 0,5)"
                          : printable(error.description())));
  }
}

TomlSection TomlSection::read(const std::filesystem::path& path) {
  return parse(read_text_file(path), path.string());
}

bool TomlSection::has(std::string_view key) const {
  return table_->table->contains(key);
}

std::string TomlSection::full_name(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

std::string TomlSection::place(std::string_view key) const {
  const toml::node* node = table_->table->get(key);
  const unsigned line = node != nullptr ? static_cast<unsigned>(node->source().begin.line) : table_->line();
  // An empty table that is not in the file has no line.
  const std::string where = line > 0 ? file_ + ":" + std::to_string(line) : file_;
  return where + ": " + printable(full_name(key)) +
         (node == nullptr ? " is missing" : " = " + value_text(*node));
}

void TomlSection::refuse(std::string_view key, const std::string& allowed) const {
  const std::string error = place(key) + ": " + allowed;
  if (!table_->document->collects) throw InputError(error);
  // A key may be read twice, but its error is noted once.
  std::vector<std::string>& errors = table_->document->errors;
  if (std::find(errors.begin(), errors.end(), error) == errors.end()) errors.push_back(error);
}

// After an error, a contradiction may come from the value that replaced an invalid one. It is then not reported.
void TomlSection::fail(std::string_view key, const std::string& allowed) const {
  if (table_->document->errors.empty()) refuse(key, allowed);
  throw InputError(joined_errors());
}

void TomlSection::collect_errors() {
  table_->document->collects = true;
}

void TomlSection::note_error(const std::string& error) {
  if (table_->document->errors.empty()) table_->document->errors.push_back(error);
}

std::string TomlSection::joined_errors() const {
  std::string text;
  for (const std::string& error : table_->document->errors) text += (text.empty() ? "" : "\n") + error;
  return text;
}

void TomlSection::throw_errors() const {
  if (!table_->document->errors.empty()) throw InputError(joined_errors());
}

void TomlSection::warn(std::string_view key, const std::string& doubt) const {
  table_->document->warnings.push_back(place(key) + ": " + doubt);
}

const std::vector<std::string>& TomlSection::warnings() const {
  return table_->document->warnings;
}

double TomlSection::number(std::string_view key, Range allowed) {
  const toml::node* node = Reader::require(*this, key);
  return node == nullptr ? allowed.min : Reader::checked(*this, key, *node, allowed);
}

double TomlSection::number_or(std::string_view key, double fallback, Range allowed) {
  const toml::node* node = Reader::find(*this, key);
  return node == nullptr ? fallback : Reader::checked(*this, key, *node, allowed);
}

std::int64_t TomlSection::integer(std::string_view key, std::int64_t min, std::int64_t max) {
  return Reader::require(*this, key) == nullptr ? min : integer_or(key, min, min, max);
}

std::int64_t TomlSection::integer_or(std::string_view key, std::int64_t fallback, std::int64_t min,
                                     std::int64_t max) {
  const toml::node* node = Reader::find(*this, key);
  if (node == nullptr) return fallback;
  const toml::value<std::int64_t>* whole = node->as_integer();
  const std::int64_t value = whole != nullptr ? whole->get() : min;
  if (whole != nullptr && value >= min && value <= max) return value;
  refuse(key, "a whole number from " + std::to_string(min) + " to " + std::to_string(max) + " is allowed" +
                  (node->is_string() ? ", without quotes" : ""));
  return std::clamp(value, min, max);
}

bool TomlSection::boolean_or(std::string_view key, bool fallback) {
  const toml::node* node = Reader::find(*this, key);
  if (node == nullptr) return fallback;
  if (node->is_boolean()) return *node->value<bool>();
  refuse(key, std::string("true or false is allowed") + (node->is_string() ? ", without quotes" : ""));
  return fallback;
}

std::string TomlSection::text(std::string_view key) {
  const toml::node* node = Reader::require(*this, key);
  if (node != nullptr && node->is_string()) return *node->value<std::string>();
  if (node != nullptr) refuse(key, "a text in quotes is allowed");
  return "";
}

std::string TomlSection::text_or(std::string_view key, std::string fallback) {
  return Reader::find(*this, key) == nullptr ? std::move(fallback) : text(key);
}

std::string TomlSection::choice(std::string_view key, const std::vector<std::string>& allowed) {
  const toml::node* node = Reader::require(*this, key);
  if (node == nullptr) return allowed.front();
  const std::optional<std::string> value = node->value_exact<std::string>();
  if (value && std::find(allowed.begin(), allowed.end(), *value) != allowed.end()) return *value;
  const std::string* nearest = value ? nearest_word(*value, allowed) : nullptr;
  refuse(key, "one of " + join(allowed, "\"") + " is allowed" +
                  (nearest != nullptr ? "; did you mean \"" + *nearest + "\"?" : ""));
  return allowed.front();
}

std::string TomlSection::choice_or(std::string_view key, std::string fallback,
                                   const std::vector<std::string>& allowed) {
  return Reader::find(*this, key) == nullptr ? std::move(fallback) : choice(key, allowed);
}

std::vector<double> TomlSection::numbers(std::string_view key, Range allowed) {
  const toml::node* node = Reader::require(*this, key);
  if (node == nullptr) return {allowed.min};
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty()) fail(key, "a list of numbers is allowed");
  std::vector<double> values;
  for (const toml::node& number : *array) values.push_back(Reader::checked(*this, key, number, allowed));
  return values;
}

TomlSection TomlSection::section(std::string_view key) {
  const toml::node* node = Reader::require(*this, key);
  if (node == nullptr) throw_errors();
  const toml::table* table = node->as_table();
  if (table == nullptr) fail(key, "a table, written [" + full_name(key) + "], is allowed");
  return {std::make_shared<const Table>(Table{table_->document, table}), file_, full_name(key)};
}

TomlSection TomlSection::section_or_empty(std::string_view key) {
  static const toml::table nothing;
  if (Reader::find(*this, key) != nullptr) return section(key);
  return {std::make_shared<const Table>(Table{table_->document, &nothing}), file_, full_name(key)};
}

std::vector<TomlSection> TomlSection::sections(std::string_view key) {
  const std::string what = "at least one table, written [[" + full_name(key) + "]],";
  const toml::node* node = Reader::require(*this, key, what);
  if (node == nullptr) throw_errors();
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous(toml::node_type::table))
    fail(key, "one or more tables are allowed, each written [[" + full_name(key) + "]] with two brackets" +
                  Reader::instead(*this, key));
  std::vector<TomlSection> result;
  for (const toml::node& table : *array)
    result.push_back({std::make_shared<const Table>(Table{table_->document, table.as_table()}), file_,
                      full_name(key) + "[" + std::to_string(result.size()) + "]"});
  return result;
}

void TomlSection::refuse_unknown_keys() const {
  const std::vector<std::string> known(asked_.begin(), asked_.end());
  for (const auto& [key, node] : *table_->table) {
    const std::string_view name = key.str();
    if (asked_.contains(name)) continue;
    const std::string* nearest = nearest_word(name, known);
    const std::string hint =
        nearest != nullptr ? "did you mean " + *nearest + "?" : "the keys here are " + join(known, "") + ".";
    refuse(name, "unknown key; " + hint + " Physical quantities carry their unit in the key." +
                     unit_conversion(name));
  }
}

}  // namespace strainwave
