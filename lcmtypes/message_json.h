// SPDX-License-Identifier: BSD-3-Clause
// Converts messages to JSON objects with the fields' own names, and makes the JSON schemas of these. MCAP files and live viewers use
// both. Not real-time.
//
// Numbers that are identifiers (..._id, challenge) become texts, because readers in JavaScript would round them. NaN and infinity become
// null. The schemas still say "number": Foxglove's reader takes one type per field, and shows nothing for a schema with alternatives.
// Modes, faults and similar numbers have a second field with words (mode_text, ...). Arrays per temperature rule end with the rules in use.
// A state also has its tracking_error_rad.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lcmtypes/message_fields.h"

namespace strainwave {

/// "strainwave.state_v1"
template <typename Message>
std::string schema_name() {
  return std::string("strainwave.").append(Message::getTypeName());
}

namespace json {

/// Builds one object; its keys are in the order of the calls.
class Object {
 public:
  void add(std::string_view name, double value);
  void add(std::string_view name, std::int64_t value);
  void add(std::string_view name, std::int32_t value) { add(name, std::int64_t{value}); }
  void add(std::string_view name, std::string_view text);
  template <typename Number>
  void add(std::string_view name, std::span<const Number> values) {
    begin(name);
    text_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (i > 0) text_ += ',';
      append(values[i]);
    }
    text_ += ']';
  }
  std::string end() && { return std::move(text_) + '}'; }

 private:
  void begin(std::string_view name);
  void append(double value);
  void append(std::int64_t value);
  void append(std::int32_t value) { append(std::int64_t{value}); }

  std::string text_ = "{";
};

/// Builds the schema of an object; each call adds a field.
class Schema {
 public:
  explicit Schema(std::string_view title);
  void number(std::string_view name);
  void integer(std::string_view name);
  void text(std::string_view name);
  void numbers(std::string_view name);
  std::string end() && { return std::move(text_) + "}}"; }

 private:
  void add(std::string_view name, std::string_view type);
  std::string text_;
  bool any_ = false;
};

/// Whether `field` is an identifier: a number of 64 bits that is compared but never used in arithmetic.
inline bool is_a_name(std::string_view field) {
  return field.ends_with("_id") || field == "challenge";
}

/// Texts for numbers that are codes: pairs of a field's name (mode_text) and its text.
using Words = std::vector<std::pair<std::string_view, std::string_view>>;
template <typename Message>
Words words_of(const Message&) {
  return {};
}
Words words_of(const state_v1& state);
Words words_of(const temperature_v1& message);
Words words_of(const ack_v1& message);

/// Values that are computed from a message: pairs of a name and a value.
using Derived = std::vector<std::pair<std::string_view, double>>;
template <typename Message>
Derived derived_from(const Message&) {
  return {};
}
Derived derived_from(const state_v1& state);

/// Returns how many entries of an array field are in use.
template <typename Message>
std::size_t used_entries(const Message&, std::string_view, std::size_t size) {
  return size;
}
std::size_t used_entries(const state_v1& state, std::string_view field, std::size_t size);

}  // namespace json

template <typename Message>
std::string message_json(const Message& message) {
  json::Object object;
  visit_fields(message, [&](const char* name, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (!std::same_as<Value, std::string_view> && requires { value.size(); }) {
      using Number = std::remove_cv_t<typename Value::element_type>;
      object.add(name, std::span<const Number>(value).first(json::used_entries(message, name, value.size())));
    } else if constexpr (std::integral<Value>) {
      if (json::is_a_name(name)) return object.add(name, std::string_view(std::to_string(value)));
      object.add(name, std::int64_t{value});
    } else {
      object.add(name, value);
    }
  });
  for (const auto& [name, words] : json::words_of(message)) object.add(name, words);
  for (const auto& [name, value] : json::derived_from(message)) object.add(name, value);
  return std::move(object).end();
}

template <typename Message>
std::string message_schema() {
  json::Schema schema(schema_name<Message>());
  const Message message{};
  visit_fields(message, [&](const char* name, const auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::same_as<Value, std::string_view>) {
      schema.text(name);
    } else if constexpr (requires { value.size(); }) {
      schema.numbers(name);
    } else if constexpr (std::integral<Value>) {
      if (json::is_a_name(name)) return schema.text(name);
      schema.integer(name);
    } else {
      schema.number(name);
    }
  });
  for (const auto& [name, words] : json::words_of(message)) schema.text(name);
  for (const auto& [name, value] : json::derived_from(message)) schema.number(name);
  return std::move(schema).end();
}

}  // namespace strainwave
