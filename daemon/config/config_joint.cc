// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_joint.h"

#include <algorithm>

#include "base/printable.h"
#include "daemon/config/config_doubts.h"
#include "daemon/config/config_gpio.h"
#include "daemon/config/config_homing.h"
#include "daemon/config/config_load.h"
#include "daemon/config/config_model.h"
#include "daemon/config/config_simulated.h"
#include "daemon/config/config_thermometer.h"
#include "lcmtypes/calm_speed.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

constexpr Range kAnyAngle{-1e4, 1e4};
// Default of derating_C: this far below the temperature limit.
constexpr double kDerates_C = 10.0;

void read_limits(TomlSection& section, double gear_ratio, JointLoopConfig& loop) {
  JointLimits& limits = loop.limits;
  limits.position_min_rad = section.number("position_min_rad", kAnyAngle);
  limits.position_max_rad = section.number("position_max_rad", kAnyAngle);
  if (limits.position_min_rad >= limits.position_max_rad)
    section.fail("position_max_rad", "a position above position_min_rad is allowed");
  limits.position_margin_rad = section.number_or("position_margin_rad", 0.05, {0.0, 10.0});
  loop.controller.motion.velocity_rad_s = section.number("speed_limit_rad_s", {1e-4, 1e3});
  loop.move_speed_share = section.number_or("move_speed_share", kCalmShare, {1e-3, 1.0});
  loop.controller.motion.acceleration_rad_s2 = section.number("acceleration_rad_s2", {1e-3, 1e6});
  loop.controller.motion.deceleration_rad_s2 =
      section.number_or("deceleration_rad_s2", loop.controller.motion.acceleration_rad_s2, {1e-3, 1e6});
  if (section.has("jerk_limit_rad_s3"))
    loop.controller.jerk_limit_rad_s3 = section.number("jerk_limit_rad_s3", {1e-2, 1e9});
  const double speed_rad_s = loop.controller.motion.velocity_rad_s;
  limits.overspeed_rad_s = section.number_or("overspeed_rad_s", 1.25 * speed_rad_s + 0.1, {speed_rad_s, 1e3});
  limits.following_error_rad = section.number("following_error_rad", {1e-6, 100.0});
  loop.controller.torque_limit_Nm = section.number("torque_limit_Nm", kPositive);
  limits.temperature_limit_C = section.number_or("temperature_limit_C", 80.0, {-50.0, 200.0});
  const double limit_C = limits.temperature_limit_C;
  limits.derating_C = section.number_or("derating_C", limit_C - kDerates_C, {-100.0, limit_C - 1.0});
  loop.overload_stop =
      section.choice_or("on_overload", "torque_off", {"torque_off", "hold_load"}) == "hold_load"
          ? OverloadStop::kHoldLoad
          : OverloadStop::kTorqueOff;
  doubt_limits(section, loop, gear_ratio);
}

void read_temperature_check(TomlSection section, JointLoopConfig& loop) {
  TemperatureCheckConfig& check = loop.temperature;
  check.min_C = section.number_or("min_C", check.min_C, {-273.0, 300.0});
  check.max_C = section.number_or("max_C", check.max_C, {check.min_C, 300.0});
  check.max_rate_C_s = section.number_or("max_rate_C_s", check.max_rate_C_s, {1e-3, 1e3});
  check.max_step_C = section.number_or("max_step_C", check.max_step_C, {1e-3, 300.0});
  check.max_age_s = section.number_or("max_age_s", check.max_age_s, {1e-3, 3600.0});
  check.loss_is_fault = section.choice_or("on_loss", "keep", {"keep", "fault"}) == "fault";
  // Readings above max_C are rejected, so the temperature limit must be below max_C.
  if (loop.limits.temperature_limit_C >= check.max_C)
    section.note_error(section.place("max_C") + ": a temperature above joint.limits.temperature_limit_C = " +
                       number_text(loop.limits.temperature_limit_C) +
                       " is allowed: the daemon rejects readings above max_C" +
                       fahrenheit_hint(loop.limits.temperature_limit_C));
  section.refuse_unknown_keys();
}

void read_timeouts(TomlSection section, JointLoopConfig& loop) {
  loop.start_timeout_s = section.number_or("start_timeout_s", loop.start_timeout_s, {0.01, 60.0});
  loop.stop_timeout_s = section.number_or("stop_timeout_s", loop.stop_timeout_s, {0.01, 60.0});
  loop.standstill_rad_s = section.number_or("standstill_rad_s", loop.standstill_rad_s, {1e-6, 1.0});
  loop.overload_s = section.number_or("overload_s", loop.overload_s, {0.0, 60.0});
  loop.blocked_s = section.number_or("blocked_s", loop.blocked_s, {0.01, 60.0});
  loop.rest_tolerance_rad = section.number_or("rest_tolerance_rad", loop.rest_tolerance_rad, {1e-9, 1.0});
  loop.missed_readings_limit =
      static_cast<int>(section.integer_or("missed_readings_limit", loop.missed_readings_limit, 0, 1000));
  section.refuse_unknown_keys();
}

void read_control(TomlSection section, JointLoopConfig& loop) {
  JointControllerConfig& controller = loop.controller;
  const double torque_limit_Nm = controller.torque_limit_Nm;
  loop.initial_load_Nm =
      section.number_or("initial_load_Nm", loop.initial_load_Nm, {-torque_limit_Nm, torque_limit_Nm});
  controller.stream_bridge_s = section.number_or("stream_bridge_s", controller.stream_bridge_s, {0.0, 0.2});
  controller.stream_delay_s = section.number_or("stream_delay_s", controller.stream_delay_s, {0.0, 0.5});
  controller.torque_reserve = section.number_or("torque_reserve", controller.torque_reserve, {0.0, 0.9});
  read_gravity(section, controller);
  section.refuse_unknown_keys();
}

// Reads the model name that the joint's gain tables must carry.
FixedString<32> read_joint_model(TomlSection& section) {
  const std::string model = section.text("joint_model");
  const bool printable = std::all_of(model.begin(), model.end(), [](char c) { return c >= ' ' && c <= '~'; });
  FixedString<32> kept(model);
  if (model.empty() || !printable || kept.view() != model)
    section.fail("joint_model",
                 "1 to 31 printable ASCII characters are allowed: the joint_model of this joint's tables");
  return kept;
}

}  // namespace

std::string read_name(TomlSection& section, std::string_view key, std::string fallback) {
  std::string name = fallback.empty() ? section.text(key) : section.text_or(key, std::move(fallback));
  if (!is_valid_name(name))
    section.fail(key, "1 to 24 of the characters A-Z a-z 0-9 _ - are allowed, not - first");
  return name;
}

JointConfig read_joint(TomlSection& section, double period_s, const std::filesystem::path& folder,
                       CanConfig& can, ConfigUse use) {
  JointConfig joint;
  joint.name = read_name(section, "name", "");
  joint.plant.joint_model = read_joint_model(section);
  joint.plant.gear_ratio = section.number("gear_ratio", {1e-3, 1e5});
  read_model(section, use, joint);
  joint.plant.period_s = period_s;
  joint.loop.controller.period_s = period_s;
  if (section.has("table")) {
    joint.table = folder / section.text("table");
    joint.table_place = section.place("table");
  }
  TomlSection limits = section.section("limits");
  read_limits(limits, joint.plant.gear_ratio, joint.loop);
  read_temperature_check(section.section_or_empty("temperature"), joint.loop);
  if (section.has("group")) joint.group = read_name(section, "group", "");
  read_timeouts(section.section_or_empty("supervision"), joint.loop);
  joint.driver = section.choice("driver", {"simulated", "can", "gpio"});
  read_control(section.section_or_empty("control"), joint.loop);
  if (section.has("thermometer"))
    joint.thermometer = read_thermometer(section.section("thermometer"), folder);
  if (joint.thermometer && joint.driver == "simulated")
    section.fail("thermometer",
                 "it is allowed only with a real drive: the simulated one has its own temperature");
  TomlSection driver = section.section_or_empty(joint.driver);
  if (joint.thermometer && driver.has("temperature"))
    section.fail("thermometer",
                 "only one temperature is allowed: this sensor, or the drive's own in joint.can.temperature");
  HomingInputs inputs;
  if (joint.driver == "can")
    inputs = can.read_joint(driver, joint);
  else if (joint.driver == "gpio")
    inputs = read_gpio_driver(driver, section.full_name("gpio"), period_s, joint);
  else
    inputs = read_simulated_driver(driver, period_s, folder, joint);
  driver.refuse_unknown_keys();
  read_homing(section.section_or_empty("homing"), inputs, joint);
  read_load_limits(limits, joint);
  doubt_inertia(section, joint);
  limits.refuse_unknown_keys();
  section.refuse_unknown_keys();
  return joint;
}

}  // namespace strainwave
