// SPDX-License-Identifier: BSD-3-Clause
// Messages as JSON objects under their fields' own names, and the JSON schemas of these: what MCAP files and live viewers carry.
// Not real-time.
//
// Numbers that only name something (..._id, challenge) are texts, since readers in JavaScript would round them; a number that is none (NaN) is null.
// The schemas say "number" of it all the same: Foxglove's reader takes one type for a field, and shows nothing of a schema with alternatives.
// Modes, faults and their like come a second time as words (mode_text, ...); weights only as far as rules are in use. A state also has
// its tracking_error_rad.
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

/// Builds one object; keys in the order of the calls.
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

/// Builds the schema of an object whose fields are these.
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

/// A number of 64 bits that is compared and never counted with.
inline bool is_a_name(std::string_view field) {
  return field.ends_with("_id") || field == "challenge";
}

/// The words of numbers that stand for something: names of fields (mode_text) and texts.
using Words = std::vector<std::pair<std::string_view, std::string_view>>;
template <typename Message>
Words words_of(const Message&) {
  return {};
}
Words words_of(const state_v1& state);
Words words_of(const temperature_v1& message);
Words words_of(const ack_v1& message);

/// What is computed from a message, by name.
using Derived = std::vector<std::pair<std::string_view, double>>;
template <typename Message>
Derived derived_from(const Message&) {
  return {};
}
Derived derived_from(const state_v1& state);

/// How many entries of an array field mean something.
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
