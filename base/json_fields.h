// SPDX-License-Identifier: BSD-3-Clause
// Writes structs as JSON and reads them. One function template passes every field with its key to a writer or a reader:
//
//   template <typename Json>
//   void fields(Json& json, Interval& interval) {
//     json("value", interval.value);
//     json("half_width_95", interval.half_width_95);
//   }
//
// A field is a number, a truth value, a text, a list of numbers, another struct with fields(), or a vector of such structs. Each may be
// optional (std::optional). Writer and reader check the requirements in fields() and throw InputError if a value violates one. The
// reader is as strict as base/strict_json.h. Not real-time.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fixed_string.h"
#include "base/input_error.h"
#include "base/number_range.h"
#include "base/strict_json.h"

namespace strainwave {

/// Limit of list entries; no list of the project is as long.
inline constexpr std::size_t kMostJsonEntries = 100'000;

template <typename Value, typename Json>
concept HasFields = requires(Json& json, Value& value) {
  fields(json, value);
};

/// A number within `range`, or a list of such numbers.
template <typename Json, typename Value>
void ranged(Json& json, const std::string& key, Value& value, Range range) {
  json(key, value);
  if constexpr (std::is_arithmetic_v<Value>)
    json.require(range.holds(value), key, range.text());
  else
    json.require(range.holds_all(value), key, range.text() + " each");
}

class JsonWriter {
 public:
  nlohmann::ordered_json document = nlohmann::ordered_json::object();

  /// `path`: key path of the object that is written, for messages.
  explicit JsonWriter(std::string path = "") : path_(std::move(path)) {}

  template <typename Value>
  void operator()(const std::string& key, Value& value) {
    if constexpr (HasFields<Value, JsonWriter>) {
      JsonWriter part(place().path_of(key));
      fields(part, value);
      document[key] = std::move(part.document);
    } else {
      document[key] = value;
    }
  }
  template <typename Value>
  void operator()(const std::string& key, std::optional<Value>& value) {
    if (value) (*this)(key, *value);
  }
  template <std::size_t N>
  void operator()(const std::string& key, FixedString<N>& value) {
    document[key] = value.view();
    require(value.is_printable(), key, "printable ASCII characters");
  }
  template <typename Entry>
  requires HasFields<Entry, JsonWriter>
  void operator()(const std::string& key, std::vector<Entry>& entries) {
    auto count = static_cast<std::int32_t>(entries.size());
    list(key, count, 0, entries.size(), [&](auto& json, std::size_t i) { fields(json, entries[i]); });
  }
  void text(const std::string& key, std::string& value, std::size_t) { document[key] = value; }
  /// Writes an enumeration or a truth value as its name.
  template <typename Value, std::size_t N>
  void name(const std::string& key, Value& value, const std::array<const char*, N>& names) {
    const auto number = static_cast<int>(value);
    document[key] = number;
    require(number >= 0 && std::cmp_less(number, N), key, "from 0 to " + std::to_string(N - 1));
    document[key] = names[static_cast<std::size_t>(number)];
  }
  void numbers(const std::string& key, std::span<double> values) { document[key] = values; }
  /// Writes the values as rows of `columns` numbers each.
  void matrix(const std::string& key, std::span<double> values, std::size_t columns) {
    auto& rows = document[key] = nlohmann::ordered_json::array();
    for (; !values.empty(); values = values.subspan(columns)) rows.push_back(values.first(columns));
  }
  /// Writes `count` objects, `least` to `most`. `entry_fields(json, index)` writes the fields of one object.
  template <typename EntryFields>
  void list(const std::string& key, std::int32_t& count, std::size_t least, std::size_t most,
            const EntryFields& entry_fields) {
    document[key] = count;
    require(std::cmp_greater_equal(count, least) && std::cmp_less_equal(count, most), key,
            "a list of " + std::to_string(least) + " to " + std::to_string(most));
    auto& entries = document[key] = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      JsonWriter entry(place().path_of(key, i));
      entry_fields(entry, i);
      entries.push_back(std::move(entry.document));
    }
  }
  /// Throws InputError unless `good`, such as "gear_ratio = -1: must be above 0". `key` is one that was written or read.
  void require(bool good, const std::string& key, const std::string& allowed) const {
    if (!good) place().complain(key, allowed);
  }
  /// Refuses a key that belongs to another kind of file; only the reader does.
  void refuse(const std::string&, const std::string&) {}
  /// Writes the file's format number. The reader refuses another number, with advice.
  void format(int expected, const std::string&) { document["format"] = expected; }

 private:
  StrictObject place() const { return {document, "", path_}; }

  std::string path_;
};

class JsonReader {
 public:
  explicit JsonReader(StrictObject object) : object_(std::move(object)) {}
  /// Refuses keys that were not read.
  void finish() const { object_.finish(); }

  template <typename Value>
  void operator()(const std::string& key, Value& value) {
    if constexpr (HasFields<Value, JsonReader>) {
      JsonReader part(object_.object(key));
      fields(part, value);
      part.finish();
    } else {
      read(key, value);
    }
  }
  template <typename Value>
  void operator()(const std::string& key, std::optional<Value>& value) {
    value.reset();
    if (object_.has(key)) (*this)(key, value.emplace());
  }
  template <typename Entry>
  requires HasFields<Entry, JsonReader>
  void operator()(const std::string& key, std::vector<Entry>& entries) {
    std::int32_t count = 0;
    list(key, count, 0, kMostJsonEntries,
         [&](auto& json, std::size_t) { fields(json, entries.emplace_back()); });
  }
  void text(const std::string& key, std::string& value, std::size_t most_bytes) {
    value = object_.text(key, most_bytes);
  }
  template <typename Value, std::size_t N>
  void name(const std::string& key, Value& value, const std::array<const char*, N>& names) {
    const std::string given = object_.text(key, kMaxTextBytes);
    const auto found = std::ranges::find(names, std::string_view(given));
    std::string allowed = names.front();
    for (std::size_t i = 1; i < N; ++i) allowed += (i + 1 < N ? ", " : " or ") + std::string(names[i]);
    require(found != names.end(), key, allowed);
    value = static_cast<Value>(found - names.begin());
  }
  void numbers(const std::string& key, std::span<double> values) {
    std::ranges::copy(object_.numbers(key, values.size()), values.begin());
  }
  void matrix(const std::string& key, std::span<double> values, std::size_t columns) {
    std::ranges::copy(object_.matrix(key, values.size() / columns, columns), values.begin());
  }
  template <typename EntryFields>
  void list(const std::string& key, std::int32_t& count, std::size_t least, std::size_t most,
            const EntryFields& entry_fields) {
    count = 0;
    for (StrictObject& object : object_.objects(key, least, most)) {
      JsonReader entry(std::move(object));
      entry_fields(entry, static_cast<std::size_t>(count++));
      entry.finish();
    }
  }
  void require(bool good, const std::string& key, const std::string& allowed) const {
    if (!good) object_.complain(key, allowed);
  }
  void refuse(const std::string& key, const std::string& explained) const {
    if (object_.has(key)) throw InputError(object_.where("") + explained);
  }
  void format(int expected, const std::string& advice) {
    if (object_.integer("format") != expected)
      throw InputError(object_.shown("format") + ": this program reads format " + std::to_string(expected) +
                       "; " + advice);
  }

 private:
  void read(const std::string& key, double& value) { value = object_.number(key); }
  void read(const std::string& key, bool& value) { value = object_.boolean(key); }
  void read(const std::string& key, std::string& value) { value = object_.text(key, kMaxTextBytes); }
  void read(const std::string& key, std::vector<double>& values) { values = object_.numbers(key); }
  template <std::integral Integer>
  void read(const std::string& key, Integer& value) {
    using Limits = std::numeric_limits<Integer>;
    const long long given = object_.integer(key);
    require(std::in_range<Integer>(given), key,
            "from " + std::to_string(Limits::min()) + " to " + std::to_string(Limits::max()));
    value = static_cast<Integer>(given);
  }
  template <std::size_t N>
  void read(const std::string& key, FixedString<N>& value) {
    value = FixedString<N>(object_.text(key, N - 1));
    require(value.is_printable(), key, "printable ASCII characters");
  }
  template <std::size_t N>
  void read(const std::string& key, std::array<double, N>& values) {
    numbers(key, values);
  }
  template <std::size_t N>
  void read(const std::string& key, std::array<std::int32_t, N>& values) {
    std::array<double, N> given{};
    numbers(key, given);
    for (std::size_t i = 0; i < N; ++i) {
      // The first comparison is false for NaN and infinity.
      require(std::abs(given[i]) < 1e9 && given[i] == std::floor(given[i]), key,
              "whole numbers of at most nine digits");
      values[i] = static_cast<std::int32_t>(given[i]);
    }
  }

  StrictObject object_;
};

/// Conversion of a whole file to and from JSON.
template <typename Value>
nlohmann::ordered_json to_document(Value value) {
  JsonWriter writer;
  fields(writer, value);
  return std::move(writer.document);
}
template <typename Value>
std::string json_text(const Value& value) {
  return to_document(value).dump(2) + "\n";
}
template <typename Value>
Value from_document(const nlohmann::ordered_json& document, const std::string& source) {
  JsonReader reader(StrictObject(document, source));
  Value value;
  fields(reader, value);
  reader.finish();
  return value;
}
template <typename Value>
Value from_json_text(std::string_view text, const std::string& source) {
  return from_document<Value>(parse_strict_json(text, source), source);
}

}  // namespace strainwave
