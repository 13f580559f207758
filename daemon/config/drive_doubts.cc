// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/drive_doubts.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/printable.h"
#include "base/units.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

namespace {

/// An encoder of 125 lines with four edges each; encoders of servo motors have more.
constexpr double kFewestCountsPerMotorTurn = 500.0;
/// Drives on CAN take less (IEC 61800-5-1: above 120 V a drive is no extra-low voltage device).
constexpr double kHighestSupply_V = 120.0;

/// Accepts a unit that was rounded to three digits, but not twice or half of a unit.
constexpr double kUnitTolerance = 0.01;
/// Object 60A9h has units down to a millionth.
constexpr double kMostDecades = 6.0;

bool is_decimal_part(double unit, double whole) {
  const double decades = std::round(std::log10(whole / unit));
  return decades >= 0.0 && decades <= kMostDecades &&
         std::abs(unit * std::pow(10.0, decades) / whole - 1.0) < kUnitTolerance;
}

/// Drives measure velocity in counts of their position, or in turns of the motor.
void doubt_velocity_unit(const TomlSection& section, const cia402::UnitConfig& units) {
  const double counts_rad_s = kTurn_rad / units.counts_per_output_revolution;
  const double rpm_rad_s = joint_velocity_rad_s_from_motor_rpm(1.0, units.gear_ratio);
  const double unit_rad_s = units.velocity_rad_s_per_unit;
  if (unit_rad_s == 0.0 || is_decimal_part(unit_rad_s, counts_rad_s) ||
      is_decimal_part(unit_rad_s, rpm_rad_s))
    return;
  section.warn(
      "velocity_rad_s_per_unit",
      "this is not a usual unit of 606Ch and 60FFh: a count per second is " + number_text(counts_rad_s) +
          ", 1 rpm of the motor " + number_text(rpm_rad_s) +
          " at the joint; a tenth or a hundredth of these is usual, too. A wrong unit makes the joint "
          "faster or slower than ordered");
}

/// Returns the largest ratio of the gear catalogue that is below `ratio` and at most `most`.
std::optional<double> smaller_ratio(double ratio, double most) {
  std::optional<double> best;
  for (const Gear& gear : gear_catalogue())
    if (gear.ratio < ratio && gear.ratio <= most) best = std::max(best.value_or(0.0), gear.ratio);
  return best;
}

}  // namespace

void doubt_drive(const TomlSection& section, const JointConfig& joint, const cia402::DriveConfig& drive) {
  const cia402::UnitConfig& units = drive.units;
  const double counts_per_motor_turn = units.counts_per_output_revolution / units.gear_ratio;
  if (joint.loop.controller.encoder_side == EncoderSide::kMotor && units.gear_ratio > 1.0 &&
      counts_per_motor_turn < kFewestCountsPerMotorTurn)
    section.warn(
        "counts_per_output_revolution",
        "this means " + number_text(counts_per_motor_turn) +
            " counts in a turn of the motor, and encoders have 500 or more; if a turn of the motor is "
            "meant, write " +
            number_text(units.counts_per_output_revolution * units.gear_ratio));
  doubt_velocity_unit(section, units);
  if (const auto doubt = cia402::torque_unit_doubt(drive.identity.vendor_id.value_or(0), units))
    section.warn("rated_torque_unit", *doubt);
}

void doubt_motor(TomlSection& motor, const JointConfig& joint, const cia402::DriveConfig& drive) {
  const cia402::UnitConfig& units = drive.units;
  const double ratio = units.gear_ratio;
  const double constant_Nm_A = units.torque_constant_Nm_A;
  if (const auto doubt = cia402::rated_torque_doubt(drive.rated_current_A * constant_Nm_A * ratio, units,
                                                    drive.torque_limit_Nm))
    motor.warn("torque_constant_Nm_A", *doubt);
  if (!motor.has("supply_V")) return;
  const double speed_rad_s = joint.loop.controller.motion.velocity_rad_s;
  const double supply_V = motor.number("supply_V", kPositive);
  const double back_emf_Vs_rad = motor.number_or("back_emf_Vs_rad", constant_Nm_A, {0.0, 1e6});
  const double needed_V = back_emf_Vs_rad * ratio * speed_rad_s;
  if (needed_V <= supply_V) return;
  // Suggests one change that suffices.
  std::string likely;
  if (const auto smaller = smaller_ratio(ratio, ratio * supply_V / needed_V))
    likely = "joint.gear_ratio = " + number_text(*smaller);
  else if (10.0 * supply_V >= needed_V && 10.0 * supply_V <= kHighestSupply_V)
    likely = "supply_V = " + number_text(10.0 * supply_V);
  else if (needed_V / ratio <= supply_V)
    likely = "the motor's own torque_constant_Nm_A = " + number_text(constant_Nm_A / ratio);
  motor.warn("supply_V", "the joint reaches " + number_text(supply_V / (back_emf_Vs_rad * ratio)) +
                             " rad/s without any torque, less than speed_limit_rad_s = " +
                             number_text(speed_rad_s) + ", which needs " + number_text(needed_V) +
                             " V (back_emf_Vs_rad = " + number_text(back_emf_Vs_rad) + ", gear_ratio = " +
                             number_text(ratio) + ")" + (likely.empty() ? "" : "; is " + likely + " meant?"));
}

}  // namespace strainwave
