// SPDX-License-Identifier: BSD-3-Clause
#include "base/strict_json.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"

namespace strainwave {

using nlohmann::ordered_json;

namespace {

/// Limit of nesting: recursion through a deeper document could exhaust the stack.
constexpr int kDeepest = 32;
constexpr std::size_t kShown = 40;
/// Longest text of a value in a message.
constexpr std::size_t kMostShown = 60;

/// Whether the parser stopped in the digits after a decimal comma: "inertia_kgm2": 0,356
bool stopped_behind_comma(std::string_view text, std::size_t at) {
  const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
  while (at > 0 && std::string_view("0123456789.eE+-").find(text[at]) != std::string_view::npos) --at;
  return at > 0 && text[at] == ',' && is_digit(at + 1) && is_digit(at - 1);
}

/// Says where the parser stopped and what the text has there, without terms of parsers. `byte` counts from 1.
std::string malformed(std::string_view text, const std::string& source, std::size_t byte) {
  const auto shown = [&](std::size_t from) {
    const std::string_view rest = text.substr(from);
    return "'" + printable(rest.substr(0, std::min(rest.find_first_of("\r\n"), kShown))) + "'";
  };
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return source + ": is empty: JSON is expected, an object in braces";
  if (text[first] != '{')
    return source + ": not valid JSON: the file begins with " + shown(first) + ", but must begin with {";
  const std::size_t at = std::min(byte > 0 ? byte - 1 : 0, text.size());
  const std::string_view before = text.substr(0, at);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::string place = source + ":" + std::to_string(line) + ": not valid JSON: ";
  if (at == text.size()) return place + "the file ends before every brace, bracket and quote is closed";
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return place + "unexpected character in column " + std::to_string(at - line_begin + 1) + " of " +
         shown(line_begin) +
         (stopped_behind_comma(text, at) ? ": numbers have a decimal point (0.5, not 0,5)" : "");
}

}  // namespace

ordered_json parse_strict_json(std::string_view text, const std::string& source) {
  // nlohmann silently keeps the last of repeated keys, but the events of its parser show every key.
  std::vector<std::set<std::string>> open_objects;
  const auto refuse_repeated_keys = [&](int depth, ordered_json::parse_event_t event, ordered_json& parsed) {
    if (depth > kDeepest)
      throw InputError(source + ": lists and objects are nested deeper than the allowed " +
                       std::to_string(kDeepest) + " levels");
    if (event == ordered_json::parse_event_t::object_start) open_objects.emplace_back();
    if (event == ordered_json::parse_event_t::object_end) open_objects.pop_back();
    if (event == ordered_json::parse_event_t::key) {
      const auto& key = parsed.get_ref<const std::string&>();
      if (!open_objects.back().insert(key).second)
        throw InputError(source + ": key \"" + printable(key) + "\" occurs twice");
    }
    return true;
  };
  // The parser would take a zero byte for the end of the text.
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
    throw InputError(source + ": not valid JSON: byte " + std::to_string(zero + 1) + " is a zero");
  try {
    return ordered_json::parse(text, refuse_repeated_keys);
  } catch (const ordered_json::parse_error& error) {
    throw InputError(malformed(text, source, error.byte));
  } catch (const ordered_json::exception& error) {
    // "[json.exception.out_of_range.406] number overflow parsing '1e999'"
    const std::string_view what = error.what();
    throw InputError(source + ": not valid JSON: " + std::string(what.substr(what.find("] ") + 2)));
  }
}

StrictObject::StrictObject(const ordered_json& value, const std::string& source, const std::string& path)
    : value_(&value), source_(source), path_(path) {
  if (!value.is_object())
    throw InputError(source + ": " + (path.empty() ? "the file" : path) + ": must be a JSON object");
}

bool StrictObject::has(const std::string& key) const {
  return value_->contains(key);
}

std::string StrictObject::path_of(const std::string& key) const {
  return (path_.empty() ? "" : path_ + ".") + printable(key);
}

std::string StrictObject::path_of(const std::string& key, std::size_t index) const {
  return path_of(key) + "[" + std::to_string(index) + "]";
}

std::string StrictObject::where(const std::string& key) const {
  return (source_.empty() ? "" : source_ + ": ") + path_of(key);
}

std::string StrictObject::shown(const std::string& key) const {
  if (!has(key) || value_->at(key).is_object()) return where(key);
  const ordered_json& value = value_->at(key);
  // JSON has no name for a number that is not finite.
  const std::string text = value.is_number_float() && !std::isfinite(value.get<double>())
                               ? number_text(value.get<double>())
                               : value.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
  return where(key) + " = " + (text.size() <= kMostShown ? text : text.substr(0, kMostShown) + "...");
}

void StrictObject::complain(const std::string& key, const std::string& allowed) const {
  throw InputError(shown(key) + ": must be " + allowed);
}

const ordered_json& StrictObject::get(const std::string& key) {
  if (!has(key)) {
    std::vector<std::string> others;
    for (const auto& [name, value] : value_->items())
      if (!read_.contains(name)) others.push_back(name);
    const std::string* nearest = nearest_word(key, others);
    throw InputError(
        where(key) + ": is missing" +
        (nearest != nullptr ? "; there is " + printable(*nearest) + ": is that what was meant?" : ""));
  }
  read_.insert(key);
  return value_->at(key);
}

double StrictObject::number(const std::string& key) {
  const ordered_json& value = get(key);
  if (!value.is_number()) complain(key, "a number");
  return value.get<double>();
}

long long StrictObject::integer(const std::string& key) {
  const ordered_json& value = get(key);
  if (!value.is_number_integer()) complain(key, "a whole number");
  constexpr auto kMost = std::numeric_limits<long long>::max();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(kMost))
    complain(key, "a whole number up to " + std::to_string(kMost));
  return value.get<long long>();
}

bool StrictObject::boolean(const std::string& key) {
  const ordered_json& value = get(key);
  if (!value.is_boolean()) complain(key, "true or false");
  return value.get<bool>();
}

std::string StrictObject::text(const std::string& key, std::size_t max_bytes) {
  const ordered_json& value = get(key);
  if (!value.is_string()) complain(key, "a text");
  std::string result = value.get<std::string>();
  if (result.size() > max_bytes) complain(key, "a text of at most " + std::to_string(max_bytes) + " bytes");
  return result;
}

StrictObject StrictObject::object(const std::string& key) {
  return {get(key), source_, path_of(key)};
}

std::vector<StrictObject> StrictObject::objects(const std::string& key, std::size_t min, std::size_t max) {
  const ordered_json& value = get(key);
  const std::string count =
      min == max ? std::to_string(min) : std::to_string(min) + " to " + std::to_string(max);
  if (!value.is_array() || value.size() < min || value.size() > max)
    complain(key, "a list of " + count + " objects");
  std::vector<StrictObject> result;
  for (std::size_t i = 0; i < value.size(); ++i) result.emplace_back(value[i], source_, path_of(key, i));
  return result;
}

std::vector<double> StrictObject::numbers(const std::string& key) {
  const ordered_json& value = get(key);
  if (!value.is_array()) complain(key, "a list of numbers");
  std::vector<double> result;
  for (const ordered_json& entry : value) {
    if (!entry.is_number()) complain(key, "a list of numbers");
    result.push_back(entry.get<double>());
  }
  return result;
}

std::vector<double> StrictObject::numbers(const std::string& key, std::size_t size) {
  std::vector<double> result = numbers(key);
  if (result.size() != size) complain(key, "a list of " + counted(size, "number"));
  return result;
}

std::vector<double> StrictObject::matrix(const std::string& key, std::size_t rows, std::size_t columns) {
  const ordered_json& value = get(key);
  const std::string allowed = counted(rows, "list") + " (the rows) of " + counted(columns, "number");
  if (!value.is_array() || value.size() != rows) complain(key, allowed);
  std::vector<double> result;
  for (const ordered_json& row : value) {
    if (!row.is_array() || row.size() != columns) complain(key, allowed);
    for (const ordered_json& entry : row) {
      if (!entry.is_number()) complain(key, allowed);
      result.push_back(entry.get<double>());
    }
  }
  return result;
}

void StrictObject::finish() const {
  for (const auto& [key, value] : value_->items()) {
    if (!read_.contains(key)) throw InputError(where(key) + ": unknown key");
  }
}

}  // namespace strainwave
