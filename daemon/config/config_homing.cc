// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_homing.h"

#include <algorithm>

namespace strainwave {

namespace {

/// Default homing speed, as a share of the joint's speed limit. A joint of 6 rad/s moves 60 urad in a period of 1 ms.
constexpr double kSpeedShare = 0.01;
/// The same against a mechanical stop, where the controller pushes harder until it detects the standstill.
constexpr double kStopSpeedShare = 0.005;

HomingTarget target_of(TomlSection& section, bool negative, const HomingInputs& available) {
  const std::string to = section.choice_or("to", "none", {"none", "home", "limit", "index", "stop"});
  const auto require = [&](bool there, const char* what) {
    if (!there) section.fail("to", std::string("this joint's driver has no ") + what + ": choose another");
  };
  if (to == "home") {
    require(available.home, "home switch");
    return HomingTarget::kHomeSwitch;
  }
  if (to == "limit") {
    require(negative ? available.negative_limit : available.positive_limit,
            negative ? "negative limit switch" : "positive limit switch");
    return HomingTarget::kLimitSwitch;
  }
  if (to == "index") {
    require(available.index, "index input");
    return HomingTarget::kIndex;
  }
  return to == "stop" ? HomingTarget::kStop : HomingTarget::kNone;
}

}  // namespace

void read_homing(TomlSection section, const HomingInputs& available, JointConfig& joint) {
  HomingConfig& homing = joint.loop.homing;
  const JointLimits& limits = joint.loop.limits;
  const double speed_rad_s = joint.loop.controller.motion.velocity_rad_s;
  const bool negative = section.choice_or("direction", "negative", {"negative", "positive"}) == "negative";
  homing.direction = negative ? -1.0 : 1.0;
  homing.target = target_of(section, negative, available);
  if (homing.target != HomingTarget::kNone && joint.loop.controller.gravity.torque_Nm != 0.0)
    section.fail(
        "to",
        "only \"none\" is allowed with joint.control.gravity_Nm: the daemon needs the true position to hold "
        "the weight from the first torque on");
  if (available.counts_from_switch_on && homing.target == HomingTarget::kNone)
    section.fail("to", "a home is needed: this joint's incremental encoder loses its position at switch-off");
  homing.required = section.boolean_or("required", available.counts_from_switch_on);
  if (available.counts_from_switch_on && !homing.required)
    section.fail("required",
                 "only true is allowed: this joint's incremental encoder loses its position at switch-off");
  if (homing.required && homing.target == HomingTarget::kNone)
    section.fail("required", "only false is allowed with joint.homing.to = \"none\"");
  homing.then_index = section.boolean_or("then_index", homing.then_index);
  const bool by_switch =
      homing.target == HomingTarget::kHomeSwitch || homing.target == HomingTarget::kLimitSwitch;
  if (homing.then_index && !(available.index && by_switch))
    section.fail("then_index", "true needs a driver with an index input, and a switch as joint.homing.to");
  if (homing.target == HomingTarget::kStop)
    homing.stop_torque_Nm = section.number("stop_torque_Nm", {1e-6, joint.loop.controller.torque_limit_Nm});
  const Range within_limits{limits.position_min_rad - limits.position_margin_rad,
                            limits.position_max_rad + limits.position_margin_rad};
  homing.home_position_rad =
      section.number_or("position_rad", std::clamp(0.0, within_limits.min, within_limits.max), within_limits);
  const double share = homing.target == HomingTarget::kStop ? kStopSpeedShare : kSpeedShare;
  homing.speed_rad_s = section.number_or("speed_rad_s", share * speed_rad_s, {1e-6, speed_rad_s});
  homing.travel_rad =
      section.number_or("travel_rad", 1.1 * (within_limits.max - within_limits.min), {1e-6, 1e4});
  // Long enough to go to one end of the travel, to the other end, and back.
  homing.timeout_s = section.number_or(
      "timeout_s", std::min(3600.0, 4.0 * homing.travel_rad / homing.speed_rad_s), {0.01, 3600.0});
  section.refuse_unknown_keys();
}

}  // namespace strainwave
