// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/state_json.h"

#include <nlohmann/json.hpp>

#include "client/text/text.h"
#include "lcmtypes/message_json.h"
#include "lcmtypes/state_fields.h"

namespace strainwave {

namespace {

nlohmann::ordered_json joint_json(const JointName& whose, const JointView& view) {
  const double age_s = seconds_between(view.received, now());
  nlohmann::ordered_json fields{{"prefix", whose.prefix}, {"joint", whose.joint}, {"age_s", age_s}};
  visit_state_fields(view.state, [&](const char* name, const auto& value) {
    if constexpr (requires { value.size(); }) {
      fields[name] = std::vector<double>(value.begin(), value.end());
    } else if (json::is_a_name(name)) {
      fields[name] = std::to_string(value);
    } else {
      fields[name] = value;
    }
  });
  fields["mode_text"] = to_text(static_cast<Mode>(view.state.mode));
  fields["fault_text"] = to_text(static_cast<Fault>(view.state.fault));
  fields["temperature_status_text"] = to_text(static_cast<TemperatureStatus>(view.state.temperature_status));
  fields["error_rad"] = tracking_error_rad(view);
  fields["notes"] = state_notes(view, age_s);
  return fields;
}

}  // namespace

std::string to_json(const StateView& states, const std::vector<JointName>& joints, int indent) {
  nlohmann::ordered_json json{{"joints", nlohmann::ordered_json::array()}};
  for (const JointName& name : joints) {
    if (const JointView* view = states.find(name.prefix, name.joint))
      json["joints"].push_back(joint_json(name, *view));
  }
  return json.dump(indent);
}

}  // namespace strainwave
