// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/failure_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/printable.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

using Json = nlohmann::ordered_json;

std::string kind_of(ExitStatus status, const ClientError::Details& details) {
  if (details.reason) return "refused";
  if (details.fault) return "faulted";
  if (details.yielded_to) return "yielded";
  switch (status) {
    case ExitStatus::kUsage:
      return "wrong input";
    case ExitStatus::kNoAnswer:
      return "no answer";
    case ExitStatus::kInterrupted:
      return "interrupted";
    default:
      return "not done";
  }
}

/// All errors have the same form: the given value, a colon, the allowed range.
void add_allowed(Json& json, const std::string& text) {
  static const std::regex given(R"(([\w.-]+) = ([^:;]*): )");
  // For a knot of a path, the name of its limit is a better key than "speed in rad/s".
  static const std::regex asked(R"((\w+) in [^=:;]* = ([^:;]*): )");
  static const std::regex limit(R"(allowed \((joint\.[\w.]+)\))");
  static const std::regex knot(R"(\bknot (\d+)\b)");
  static const std::regex allowed(R"((?:: |; )([^:;]*) (?:is|are) allowed)");
  std::smatch found;
  if (!std::regex_search(text, found, allowed)) return;
  const std::string range = found[1];
  const std::string before = text.substr(0, static_cast<std::size_t>(found.position()) + 2);
  if (std::regex_search(before, found, knot)) json["knot"] = std::stol(found[1]);
  if (std::regex_search(before, found, asked)) {
    json["given"] = std::string(found[2]);
    std::smatch limited;
    json["key"] = std::regex_search(text, limited, limit) ? limited[1] : found[1];
  } else if (std::regex_search(before, found, given)) {
    json["key"] = std::string(found[1]);
    json["given"] = std::string(found[2]);
  }
  json["allowed"] = range;
}

void add_joints(Json& json, const std::string& joint, const std::vector<std::string>& named) {
  if (!joint.empty())
    json["joint"] = joint;
  else if (named.size() == 1)
    json["joint"] = named.front();
  else if (!named.empty())
    json["joints"] = named;
}

void add_details(Json& json, const ClientError::Details& details) {
  if (details.reason) {
    json["reason"] = static_cast<int>(*details.reason);
    json["reason_text"] = to_text(*details.reason);
  }
  if (details.fault) {
    json["fault"] = static_cast<int>(*details.fault);
    json["fault_text"] = to_text(*details.fault);
  }
  if (details.yielded_to) {
    json["yield_load_Nm"] = details.yielded_to->load_Nm;
    json["yield_limit_Nm"] = details.yielded_to->limit_Nm;
    json["yield_position_rad"] = details.yielded_to->position_rad;
  }
}

Json json_of(ExitStatus status, const std::string& text, const ClientError::Details& details,
             const FailedCommand& command) {
  Json json{{"error", kind_of(status, details)}, {"exit_status", static_cast<int>(status)}};
  if (!command.command.empty()) json["command"] = command.command;
  if (details.each.empty()) {
    add_joints(json, details.joint, command.joints);
    add_details(json, details);
    add_allowed(json, text);
  } else {
    add_joints(json, "", command.joints);
  }
  for (const ClientError& one : details.each)
    json["failures"].push_back(
        json_of(one.status(), printable_lines(one.what()), one.details(), {command.command, {}}));
  json["text"] = text;
  return json;
}

}  // namespace

std::string to_json(const ProgramFailure& failure, const FailedCommand& command) {
  const auto* error = dynamic_cast<const ClientError*>(&failure.error);
  const ClientError::Details none;
  return json_of(failure.status, printable_lines(failure.error.what()),
                 error != nullptr ? error->details() : none, command)
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace strainwave
