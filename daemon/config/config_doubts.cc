#include "daemon/config/config_doubts.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "base/printable.h"

namespace strainwave {

namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kRadianPerDegree = kTurn_rad / 360.0;
// Of errors and margins: a sixth of a turn is no small angle.
constexpr double kLargeError_rad = 1.0;
// The fastest input of a strain-wave gear: CSF-8 to CSF-14 with oil.
constexpr double kFastestInput_rad_s = 14000.0 / 60.0 * kTurn_rad;
// Above this many times its speed limit a joint runs away rather than overshoots.
constexpr double kLargeOverspeed = 2.0;
// What a joint does on its own over a longer absence of the loop is no small thing.
constexpr double kLongAbsence_s = 0.1;
constexpr double kLargeShare = 0.5;

}  // namespace

void doubt_angle(const TomlSection& section, std::string_view key, double angle_rad, double usual_rad) {
  if (!section.has(key) || std::abs(angle_rad) <= usual_rad * (1.0 + 1e-3)) return;
  std::ostringstream doubt;
  doubt.precision(5);
  doubt << "are " << angle_rad / kTurn_rad << " turns of the joint; if degrees are meant, write "
        << angle_rad * kRadianPerDegree;
  section.warn(key, doubt.str());
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
    doubt << "makes the motor turn at " << std::round(speed_rad_s * gear_ratio / kTurn_rad * 60.0)
          << " rpm, no strain-wave gear above 14000; if degrees are meant, write "
          << speed_rad_s * kRadianPerDegree;
    section.warn("speed_limit_rad_s", doubt.str());
  }
  if (section.has("overspeed_rad_s") && limits.overspeed_rad_s > kLargeOverspeed * speed_rad_s)
    section.warn("overspeed_rad_s", "a joint that runs away is stopped only at " +
                                        number_text(limits.overspeed_rad_s / speed_rad_s) +
                                        " times its speed limit; left out it is a quarter above it");
}

void doubt_loop(const TomlSection& section, const LoopConfig& loop) {
  const OverrunLimits defaults;
  const auto off = [&](const char* key, bool doubtful, const std::string& what, double usual) {
    if (section.has(key) && doubtful) section.warn(key, what + "; left out it is " + number_text(usual));
  };
  off("overrun_limit", loop.overruns.in_a_row * loop.period_s > kLongAbsence_s,
      "a loop that is late cycle after cycle is stopped only after " +
          number_text(loop.overruns.in_a_row * loop.period_s) + " s",
      defaults.in_a_row);
  off("stall_limit_s", loop.overruns.stall_s > kLongAbsence_s,
      "for so long a joint may be without control before it is a fault", defaults.stall_s);
  off("missed_share_limit", loop.overruns.missed_share > kLargeShare,
      loop.overruns.missed_share >= 1.0
          ? "however many periods are missed is no fault: the supervision is off"
          : "so large a share of the periods may be missed without a fault",
      defaults.missed_share);
}

}  // namespace strainwave
