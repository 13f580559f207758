// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/message_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "lcmtypes/cycle_fields.h"
#include "strainwave/vocabulary.h"

namespace strainwave::json {

namespace {

/// Returns `text` in quotes, without control characters for a terminal. Bytes that are not UTF-8 become the replacement character.
std::string quoted(std::string_view text) {
  return nlohmann::json(printable(text)).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void Object::begin(std::string_view name) {
  if (text_.size() > 1) text_ += ',';
  text_ += '"';
  text_ += name;
  text_ += "\":";
}

void Object::append(double value) {
  text_ += std::isfinite(value) ? fmt::format("{}", value) : "null";
}

void Object::append(std::int64_t value) {
  text_ += fmt::format("{}", value);
}

void Object::add(std::string_view name, double value) {
  begin(name);
  append(value);
}

void Object::add(std::string_view name, std::int64_t value) {
  begin(name);
  append(value);
}

void Object::add(std::string_view name, std::string_view text) {
  begin(name);
  text_ += quoted(text);
}

Schema::Schema(std::string_view title)
    : text_(fmt::format(R"({{"title":"{}","type":"object","properties":{{)", title)) {}

void Schema::add(std::string_view name, std::string_view type) {
  if (any_) text_ += ',';
  any_ = true;
  text_ += fmt::format("\"{}\":{{{}}}", name, type);
}

void Schema::number(std::string_view name) {
  add(name, R"("type":"number")");
}
void Schema::integer(std::string_view name) {
  add(name, R"("type":"integer")");
}
void Schema::text(std::string_view name) {
  add(name, R"("type":"string")");
}
void Schema::numbers(std::string_view name) {
  add(name, R"("type":"array","items":{"type":"number"})");
}

Words words_of(const state_v1& state) {
  return {{"mode_text", to_text(static_cast<Mode>(state.mode))},
          {"fault_text", to_text(static_cast<Fault>(state.fault))},
          {"temperature_status_text", to_text(static_cast<TemperatureStatus>(state.temperature_status))}};
}

Words words_of(const temperature_v1& message) {
  return {{"status_text", to_text(static_cast<TemperatureStatus>(message.status))}};
}

Words words_of(const ack_v1& message) {
  return {{"reason_text", to_text(static_cast<Reason>(message.reason))}};
}

Derived derived_from(const state_v1& state) {
  return {{"tracking_error_rad", tracking_error_rad(state)}};
}

// Every array of a state has an entry for each temperature rule.
std::size_t used_entries(const state_v1& state, std::string_view, std::size_t size) {
  return std::min(size, static_cast<std::size_t>(std::max(state.rule_count, 0)));
}

}  // namespace strainwave::json
