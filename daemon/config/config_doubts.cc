// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_doubts.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <span>
#include <sstream>
#include <system_error>

#include "base/printable.h"
#include "base/protected_file.h"
#include "base/units.h"

namespace strainwave {

namespace {

constexpr double kRadianPerDegree = kTurn_rad / 360.0;
// Largest usual error limit or margin: about a sixth of a turn.
constexpr double kLargeError_rad = 1.0;
// The fastest input of a strain-wave gear: CSF-8 to CSF-14 with oil.
constexpr double kFastestInput_rad_s = 14000.0 / 60.0 * kTurn_rad;
// Above this multiple of its speed limit, a joint does not just overshoot: it runs away.
constexpr double kLargeOverspeed = 2.0;
// During a longer absence of the loop, a joint can move far without control.
constexpr double kLongAbsence_s = 0.1;
// Longest usual times to full speed, and for half a turn. A robot's joint needs tenths of a second; beyond these it hardly moves.
constexpr double kSlowStart_s = 2.0;
constexpr double kSlowTurn_s = 120.0;
// Half a decade, sqrt(10): beyond this factor, a tenth of the value is nearer to the largest possible one.
constexpr double kMisplacedPoint = 3.16;
// No motor withstands more. 120 degrees Fahrenheit are 49 degC, a usual limit.
constexpr double kHottest_C = 120.0;
// Least share of the torque limit that friction and gravity must leave for motion.
constexpr double kLeastSpare = 0.1;

std::string rounded(double value) {
  std::ostringstream text;
  text.precision(4);
  text << value;
  return text.str();
}

// Warns of each limit that keeps the joint from practically moving at all.
void doubt_motion(const TomlSection& section, const JointLoopConfig& loop) {
  const double speed_rad_s = loop.controller.motion.velocity_rad_s;
  const double way_rad =
      std::min(loop.limits.position_max_rad - loop.limits.position_min_rad, 0.5 * kTurn_rad);
  if (const double way_s = way_rad / speed_rad_s; way_s > kSlowTurn_s)
    section.warn("speed_limit_rad_s", "a motion of " + rounded(way_rad) + " rad takes " + rounded(way_s) +
                                          " s; with " + rounded(way_rad / 60.0) + " it takes a minute");
  const auto slow_start = [&](const char* key, double start_s, double in_a_second) {
    if (start_s > kSlowStart_s)
      section.warn(key, "the joint needs " + rounded(start_s) + " s to reach speed_limit_rad_s = " +
                            rounded(speed_rad_s) + "; with " + rounded(in_a_second) + " it needs one second");
  };
  slow_start("acceleration_rad_s2", speed_rad_s / loop.controller.motion.acceleration_rad_s2, speed_rad_s);
  // v = j (t / 2)^2: the acceleration rises for one half and falls for the other.
  if (const auto jerk_rad_s3 = loop.controller.jerk_limit_rad_s3)
    slow_start("jerk_limit_rad_s3", 2.0 * std::sqrt(speed_rad_s / *jerk_rad_s3), 4.0 * speed_rad_s);
}

}  // namespace

void doubt_angle(const TomlSection& section, std::string_view key, double angle_rad, double usual_rad) {
  if (!section.has(key) || std::abs(angle_rad) <= usual_rad * (1.0 + 1e-3)) return;
  std::ostringstream doubt;
  doubt.precision(5);
  doubt << "this means " << angle_rad / kTurn_rad << " turns of the joint; if degrees are meant, write "
        << angle_rad * kRadianPerDegree;
  section.warn(key, doubt.str());
}

std::string fahrenheit_hint(double limit_C) {
  if (limit_C <= kHottest_C) return {};
  return "; if degrees Fahrenheit are meant, write " + rounded((limit_C - 32.0) / 1.8);
}

void doubt_limits(const TomlSection& section, const JointLoopConfig& loop, double gear_ratio) {
  const JointLimits& limits = loop.limits;
  doubt_angle(section, "position_min_rad", limits.position_min_rad, kTurn_rad);
  doubt_angle(section, "position_max_rad", limits.position_max_rad, kTurn_rad);
  doubt_angle(section, "position_margin_rad", limits.position_margin_rad, kLargeError_rad);
  doubt_angle(section, "following_error_rad", limits.following_error_rad, kLargeError_rad);
  const double speed_rad_s = loop.controller.motion.velocity_rad_s;
  if (speed_rad_s * gear_ratio > kFastestInput_rad_s) {
    std::ostringstream doubt;
    doubt.precision(5);
    doubt << "the motor would turn at " << std::round(speed_rad_s * gear_ratio / kTurn_rad * 60.0)
          << " rpm, and strain-wave gears allow at most 14000; if degrees are meant, write "
          << speed_rad_s * kRadianPerDegree;
    section.warn("speed_limit_rad_s", doubt.str());
  }
  doubt_motion(section, loop);
  if (limits.temperature_limit_C > kHottest_C)
    section.warn("temperature_limit_C",
                 "too hot for the grease of any gear" + fahrenheit_hint(limits.temperature_limit_C));
  if (section.has("overspeed_rad_s") && limits.overspeed_rad_s > kLargeOverspeed * speed_rad_s)
    section.warn("overspeed_rad_s", "the daemon stops a runaway joint only at " +
                                        number_text(limits.overspeed_rad_s / speed_rad_s) +
                                        " times its speed limit; the default is about 1.25 times");
}

void doubt_inertia(const TomlSection& section, const JointConfig& joint) {
  const JointControllerConfig& controller = joint.loop.controller;
  const double inertia_kgm2 = joint.plant.inertia_kgm2;
  const double most_kgm2 = controller.torque_limit_Nm / controller.motion.acceleration_rad_s2;
  if (inertia_kgm2 <= most_kgm2) return;
  std::string doubt =
      "torque_limit_Nm = " + number_text(controller.torque_limit_Nm) + " gives this inertia at most " +
      rounded(controller.torque_limit_Nm / inertia_kgm2) +
      " rad/s2, less than acceleration_rad_s2 = " + number_text(controller.motion.acceleration_rad_s2) +
      ": motions last longer than that limit promises";
  // If there are two inertias, the larger one is in doubt.
  const double motor_kgm2 = controller.link ? controller.link->motor_inertia_kgm2 : 0.0;
  const double doubted_kgm2 = std::max(motor_kgm2, inertia_kgm2 - motor_kgm2);
  const double spare_kgm2 = most_kgm2 - (inertia_kgm2 - doubted_kgm2);
  // A misplaced decimal point means a factor of at least ten. A smaller excess means that a limit is too high.
  double likely_kgm2 = doubted_kgm2 / 10.0;
  while (spare_kgm2 > 0.0 && likely_kgm2 > spare_kgm2) likely_kgm2 /= 10.0;
  if (spare_kgm2 > 0.0 && inertia_kgm2 > kMisplacedPoint * most_kgm2)
    doubt += "; is " + rounded(likely_kgm2) + " meant?";
  const char* const key = doubted_kgm2 == motor_kgm2 ? "motor_inertia_kgm2" : "load_inertia_kgm2";
  section.warn(controller.link ? key : "inertia_kgm2", doubt);
}

std::vector<std::string> doubt_torque(const std::string& joint, const JointControllerConfig& controller,
                                      const GainTable& table) {
  std::vector<std::string> doubts;
  const double holds_Nm = controller.torque_limit_with(table);
  const auto note = [&](const auto& write) {
    std::ostringstream doubt;
    doubt.precision(4);
    doubt << joint << ": torque limit " << holds_Nm
          << " N.m (the lower of joint.limits.torque_limit_Nm = " << controller.torque_limit_Nm
          << " and the table's " << table.torque_limit_Nm << "): ";
    write(doubt);
    doubts.push_back(doubt.str());
  };
  const auto rules =
      std::span(table.friction.rules).first(static_cast<std::size_t>(table.friction.rule_count));
  const TemperatureRule& hardest = *std::max_element(
      rules.begin(), rules.end(),
      [](const auto& a, const auto& b) { return a.friction.static_Nm < b.friction.static_Nm; });
  const double gravity_Nm = controller.gravity.torque_Nm;
  const double needed_Nm = hardest.friction.static_Nm + gravity_Nm;
  if (holds_Nm * (1.0 - kLeastSpare) < needed_Nm)
    note([&](std::ostream& doubt) {
      doubt << "at " << hardest.center_C << " degC static friction takes " << hardest.friction.static_Nm
            << " N.m";
      if (gravity_Nm > 0.0) doubt << " and gravity " << gravity_Nm << " N.m";
      doubt << (holds_Nm > needed_Nm ? ", and hardly any torque is left for motion"
                                     : ", and the joint does not move")
            << "; " << needed_Nm / (1.0 - kLeastSpare) << " N.m or more would be enough";
    });
  return doubts;
}

void doubt_folder(const TomlSection& section, std::string_view key, const std::filesystem::path& folder) {
  // The nearest folder above that exists decides.
  std::filesystem::path there = std::filesystem::absolute(folder).lexically_normal();
  std::error_code error;
  while (!std::filesystem::exists(std::filesystem::symlink_status(there, error)) && there.has_relative_path())
    there = there.parent_path();
  if (!std::filesystem::is_directory(there, error))
    section.warn(
        key, "the daemon cannot write there: " + there.string() + " is not a folder; name another folder");
  else if (::access(there.c_str(), W_OK | X_OK) != 0)
    section.warn(key, "user " + std::to_string(::geteuid()) + " cannot write there: " + there.string() +
                          ": " + std::generic_category().message(errno) +
                          "; name another folder, or give this one to the daemon's user");
  else if (const auto exposure = find_exposure(there, Writers::kGroup))
    section.warn(key, "other users can write there, and could replace a record: " + *exposure);
  else if (there == std::filesystem::absolute(folder).lexically_normal() &&
           (std::filesystem::status(there, error).permissions() & std::filesystem::perms::others_write) !=
               std::filesystem::perms::none)
    section.warn(
        key, "every user can write there, and could leave a false record: name a folder of the daemon's own");
}

void doubt_loop(const TomlSection& section, const LoopConfig& loop, double usual_stall_s) {
  const OverrunLimits defaults;
  const auto off = [&](const char* key, bool doubtful, const std::string& what, double usual) {
    if (section.has(key) && doubtful) section.warn(key, what + "; the default is " + number_text(usual));
  };
  off("stall_limit_s", loop.overruns.stall_s > kLongAbsence_s,
      "a joint may be without control for this long before that is a fault", usual_stall_s);
  off("missed_share_limit", loop.overruns.missed_share >= 1.0,
      "missed periods are never a fault: the supervision is off", defaults.missed_share);
}

}  // namespace strainwave
