// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_log.h"

#include <limits>
#include <optional>
#include <set>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>

#include "base/input_error.h"
#include "lcmtypes/channels.h"
#include "lcmtypes/event_log.h"
#include "lcmtypes/wire.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

/// Contents of a log for one joint, before require_enough() checks them.
struct Contents {
  std::vector<state_v1> states;
  std::optional<limits_v1> limits;
  std::set<std::string> joints;
};

Contents read_contents(const std::filesystem::path& file, const std::string& joint) {
  Contents contents;
  EventLogReader reader(file);
  for (LogEvent event; reader.next(event);) {
    const auto name = parse_channel(event.channel);
    if (!name || name->joint.empty() || (!joint.empty() && name->joint != joint)) continue;
    contents.joints.insert(name->prefix + "." + name->joint);
    if (name->kind == channel_kind::kState) {
      if (const auto state = decode_exactly<state_v1>(event.data)) contents.states.push_back(*state);
    } else if (name->kind == channel_kind::kLimits) {
      if (const auto limits = decode_exactly<limits_v1>(event.data)) contents.limits = *limits;
    }
  }
  require_undamaged(reader, file);
  return contents;
}

void require_enough(const Contents& contents, const std::string& name) {
  if (contents.joints.size() > 1)
    throw InputError(name + ": holds " + std::to_string(contents.joints.size()) +
                     " joints: say which one with --joint, and record each prefix by itself");
  if (contents.states.empty())
    throw InputError(name + ": holds no states of the joint: record it with strainwavectl identify");
  if (!contents.limits)
    throw InputError(
        name +
        ": holds no LIMITS of the joint: record for more than a second, or with strainwavectl identify");
  for (const state_v1& state : contents.states) {
    if (state.session_id != contents.limits->session_id)
      throw InputError(name + ": the daemon was restarted while it was recorded: record again");
  }
  if (!(contents.limits->period_s > 0.0) || !(contents.limits->inertia_kgm2 > 0.0) ||
      !(contents.limits->gear_ratio > 0.0))
    throw InputError(name + ": its LIMITS are invalid: period, inertia and gear ratio must be above 0");
}

}  // namespace

FrictionLog read_friction_log(const std::filesystem::path& file, const std::string& joint) {
  const Contents contents = read_contents(file, joint);
  require_enough(contents, file.string());
  const limits_v1& limits = *contents.limits;
  FrictionLog log;
  log.joint = *contents.joints.begin();
  log.joint_model.assign(std::begin(limits.joint_model), std::end(limits.joint_model));
  log.joint_model.resize(std::min(log.joint_model.find('\0'), log.joint_model.size()));
  log.inertia_kgm2 = limits.inertia_kgm2;
  log.gear_ratio = limits.gear_ratio;
  for (const state_v1& state : contents.states) {
    const bool known = static_cast<TemperatureStatus>(state.temperature_status) == TemperatureStatus::kValid;
    log.samples.push_back({static_cast<double>(state.cycle) * limits.period_s,
                           static_cast<Mode>(state.mode) == Mode::kTracking, state.setpoint_velocity_rad_s,
                           state.joint_position_rad, state.joint_velocity_rad_s, state.torque_applied_Nm,
                           known ? state.temperature_used_C : std::numeric_limits<double>::quiet_NaN()});
  }
  return log;
}

}  // namespace strainwave
