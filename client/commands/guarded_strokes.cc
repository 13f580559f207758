// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/guarded_strokes.h"

#include <fmt/format.h>

#include <cmath>

#include "client/protocol/orders.h"
#include "client/text/text.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

// The stream ends by itself this long after this program ends.
constexpr double kValidFor_s = 0.5;
constexpr double kRenewEvery_s = 0.1;
// Tolerated time beyond the expected duration of a leg.
constexpr double kPatience_s = 5.0;
// The setpoint counts as arrived within this distance of the target.
constexpr double kArrived_rad = 1e-3;

}  // namespace

void require_holding(const JointView& view, const std::string& joint) {
  const auto mode = static_cast<Mode>(view.state.mode);
  if (mode == Mode::kFaulted)
    throw ClientError(ExitStatus::kRefused,
                      fmt::format("{0}: is faulted; once the cause is gone: strainwavectl clear-fault {0}; "
                                  "to find the cause: strainwavectl doctor --log FLIGHT_RECORD",
                                  joint));
  if (mode != Mode::kHolding)
    throw ClientError(ExitStatus::kRefused,
                      fmt::format("{}: is {}, not holding: strainwavectl enable {}, or hold {}", joint,
                                  to_text(mode), joint, joint));
}

void GuardedStrokes::go(double target_rad, double speed_rad_s) {
  setpoint_v1 setpoint{};
  setpoint.position_rad = target_rad;
  setpoint.valid_for_s = kValidFor_s;
  setpoint.speed_limit_rad_s = speed_rad_s;
  setpoint.stream_id = client_.new_stream();
  begin(setpoint);
  const double expected_s = std::abs(target_rad - state().joint_position_rad) / speed_rad_s;
  const Deadline late(expected_s + kPatience_s);
  const Deadline old_states(kOldStates_s);
  while (!arrived(target_rad)) {
    client_.send(joint_, channel_kind::kSetpoint, setpoint);
    const Deadline renewal(kRenewEvery_s);
    while (!renewal.passed() && !arrived(target_rad)) {
      client_.wait_until([] { return false; }, Deadline(0.01));
      check(old_states.passed() ? std::optional(target_rad) : std::nullopt);
    }
    if (late.passed())
      throw ClientError(ExitStatus::kRefused, fmt::format("{}: did not arrive at {:.4f} rad in {:.1f} s",
                                                          joint_, target_rad, expected_s + kPatience_s));
  }
}

// A stream begins with an acknowledged setpoint, so that its loss is noticed.
void GuardedStrokes::begin(setpoint_v1 setpoint) {
  setpoint.begins_stream = 1;
  setpoint.approach = 1;
  setpoint.acknowledge = 1;
  require_accepted(client_.request(joint_, channel_kind::kSetpoint, setpoint), joint_, "a setpoint");
  guarded_.accepted();
}

bool GuardedStrokes::arrived(double target_rad) const {
  return std::abs(state().setpoint_position_rad - target_rad) < kArrived_rad &&
         state().setpoint_velocity_rad_s == 0.0;
}

void GuardedStrokes::check(std::optional<double> target_rad) {
  guarded_.require_undisturbed();
  if (target_rad && state().target_position_rad != *target_rad)
    throw ClientError(ExitStatus::kRefused,
                      joint_ +
                          ": another command replaced this one, or this PC sent its setpoints too late: see "
                          "the notices in strainwavectl status");
  const double torque_Nm = std::abs(state().torque_applied_Nm);
  if (torque_Nm > max_torque_Nm_)
    throw ClientError(ExitStatus::kRefused,
                      fmt::format("{}: the torque of {:.1f} N.m exceeds the allowed {:.1f} N.m", joint_,
                                  torque_Nm, max_torque_Nm_));
}

void GuardedStrokes::rest(double duration_s) {
  const Deadline end(duration_s);
  while (!end.passed()) {
    client_.wait_until([] { return false; }, Deadline(0.01));
    check(std::nullopt);
  }
}

}  // namespace strainwave
