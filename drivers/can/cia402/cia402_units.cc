// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/cia402_units.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/input_error.h"
#include "base/printable.h"
#include "drivers/can/hexadecimal.h"

namespace strainwave::cia402 {

namespace {

constexpr std::uint32_t kMaxon = 0x000000FB;
constexpr std::uint32_t kElmo = 0x0000009A;

/// Peak and rms amperes differ by 1.41; gear losses and rounding add a little.
constexpr double kTolerance = 1.6;
constexpr double kMillinewtonmetre_Nm = 1e-3;
constexpr double kMicronewtonmetre_Nm = 1e-6;
constexpr double kPerMille = 1000.0;
constexpr double kMostCounts = 1e15;
/// A gear tolerates several times the motor's rated torque, so the joint's limit is usually above the rated
/// torque. A factor of three in the other direction leaves room for a large motor.
constexpr double kMostRatedShare = 3.0;

bool fits(double a, double b) {
  return a > 0.0 && b > 0.0 && a < b * kTolerance && b < a * kTolerance;
}

double rated_motor_Nm(const RatedValues& rated, double unit_Nm, bool at_joint, double gear_ratio) {
  return rated.torque * unit_Nm / (at_joint ? gear_ratio : 1.0);
}

std::string setting(double unit_Nm, bool at_joint) {
  return std::string("rated_torque_unit = \"") + (unit_Nm == kMillinewtonmetre_Nm ? "mNm" : "uNm") +
         "\" with torque_side = \"" + (at_joint ? "joint" : "motor") + "\"";
}

struct VelocityUnit {
  std::string text;
  double rad_s = 0.0;
};

// Bytes of 60A9h: power of ten, unit of angle, unit of time, reserved.
std::optional<VelocityUnit> velocity_unit(std::uint32_t unit) {
  struct Code {
    std::uint32_t code;
    double value;
    const char* name;
  };
  constexpr Code kAngles[]{{0xB4, kTurn_rad, "rev"}, {0x10, 1.0, "rad"}, {0x41, kTurn_rad / 360.0, "deg"}};
  constexpr Code kTimes[]{{0x03, 1.0, "s"}, {0x47, 60.0, "min"}};
  const double power = std::pow(10.0, static_cast<std::int8_t>(unit >> 24U));
  for (const Code& angle : kAngles)
    for (const Code& time : kTimes)
      if ((unit >> 16U & 0xFFU) == angle.code && (unit >> 8U & 0xFFU) == time.code)
        return VelocityUnit{number_text(power) + " " + angle.name + "/" + time.name,
                            power * angle.value / time.value};
  return std::nullopt;
}

/// Equal within the rounding of a configured number to three digits.
bool is_near(double a, double b) {
  return std::abs(a - b) < 1e-2 * b;
}

/// Returns the settings that agree with the current, for the message.
std::string fitting_settings(const RatedValues& rated, const UnitConfig& units, double expected_Nm) {
  std::string text;
  for (const double unit_Nm : {kMillinewtonmetre_Nm, kMicronewtonmetre_Nm})
    for (const bool at_joint : {false, true})
      if (fits(rated_motor_Nm(rated, unit_Nm, at_joint, units.gear_ratio), expected_Nm))
        text += (text.empty() ? "" : ", or ") + setting(unit_Nm, at_joint);
  return text;
}

}  // namespace

double rated_joint_torque_Nm(const RatedValues& rated, const UnitConfig& units, const std::string& where) {
  const double motor_Nm =
      rated_motor_Nm(rated, units.rated_torque_unit_Nm, units.torque_at_joint, units.gear_ratio);
  const double expected_Nm = rated.current_mA * 1e-3 * units.torque_constant_Nm_A;
  if (fits(motor_Nm, expected_Nm)) return motor_Nm * units.gear_ratio;
  std::ostringstream text;
  text << where << ": rated torque 6076h = " << rated.torque << " is " << motor_Nm
       << " N.m at the motor with " << setting(units.rated_torque_unit_Nm, units.torque_at_joint)
       << ", but rated current 6075h = " << rated.current_mA
       << " mA times torque_constant_Nm_A = " << units.torque_constant_Nm_A << " is " << expected_Nm
       << " N.m: ";
  const std::string fitting = fitting_settings(rated, units, expected_Nm);
  if (fitting.empty())
    text << "no unit makes them agree; check 6075h and 6076h against the motor's data sheet, and the torque "
            "constant";
  else
    text << fitting << " would agree; check which setting is right before you apply torque";
  throw InputError(text.str());
}

std::string velocity_unit_text(std::uint32_t unit, const UnitConfig& units, const std::string& where) {
  const double given_rad_s = units.velocity_rad_s_per_unit;
  const std::string given = "velocity_rad_s_per_unit = " + number_text(given_rad_s);
  const std::string object = "60A9h = " + hexadecimal(unit, 8);
  const std::optional<VelocityUnit> found = velocity_unit(unit);
  if (!found)
    return where + ": the unit of velocity is unchecked: " + given + " is used, and " +
           (unit == 0 ? "the drive does not give its unit (60A9h)" : "the daemon does not know " + object);
  const double at_motor_rad_s = found->rad_s / units.gear_ratio;
  const std::string says = "the drive's unit of velocity is " + found->text + " (" + object + ")";
  if (is_near(given_rad_s, at_motor_rad_s))
    return where + ": " + says + ", at the motor according to " + given;
  if (is_near(given_rad_s, found->rad_s)) return where + ": " + says + ", at the joint according to " + given;
  throw InputError(where + ": " + given + ", but " + says + ": " + number_text(at_motor_rad_s) +
                   " is allowed if this is the motor's velocity, " + number_text(found->rad_s) +
                   " if it is the joint's");
}

std::optional<std::string> rated_torque_doubt(double rated_Nm, const UnitConfig& units, double limit_Nm) {
  if (rated_Nm <= kMostRatedShare * limit_Nm) return std::nullopt;
  std::ostringstream text;
  text << "torque_constant_Nm_A = " << units.torque_constant_Nm_A << " gives " << rated_Nm
       << " N.m at the joint with the rated current, but torque_limit_Nm is " << limit_Nm
       << "; if the constant is the joint's, the motor's is "
       << units.torque_constant_Nm_A / units.gear_ratio;
  return text.str();
}

std::optional<std::string> torque_unit_doubt(std::uint32_t vendor_id, const UnitConfig& units) {
  const bool micro = units.rated_torque_unit_Nm < 1e-4;
  if (vendor_id == kMaxon && !micro) return "maxon's drives give 6076h in uNm: \"uNm\" is likely meant";
  if (vendor_id == kElmo && micro) return "Elmo's drives give 6076h in mNm: \"mNm\" is likely meant";
  return std::nullopt;
}

TorqueScale::TorqueScale(double rated_Nm, int direction, double limit_Nm)
    : unit_Nm_(direction * rated_Nm / kPerMille) {
  const double limit = std::floor(limit_Nm / rated_Nm * kPerMille + 1e-9);
  limit_ = static_cast<std::uint16_t>(std::clamp(limit, 0.0, static_cast<double>(INT16_MAX)));
}

std::int16_t TorqueScale::per_mille(double joint_torque_Nm) const noexcept {
  const double wanted = joint_torque_Nm / unit_Nm_;
  if (!std::isfinite(wanted)) return 0;
  const double limit = limit_;
  return static_cast<std::int16_t>(std::lround(std::clamp(wanted, -limit, limit)));
}

PositionScale::PositionScale(const UnitConfig& units)
    : rad_per_count_(units.direction * kTurn_rad / units.counts_per_output_revolution),
      offset_rad_(units.position_offset_rad),
      velocity_rad_s_per_unit_(units.direction * units.velocity_rad_s_per_unit) {}

double PositionScale::elsewhere_rad(std::int32_t counts) const noexcept {
  const auto ahead = static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) -
                                               static_cast<std::uint32_t>(last_counts_));
  return rad_per_count_ * static_cast<double>(total_counts_ + ahead) + offset_rad_;
}

std::int32_t PositionScale::counts(double position_rad) const noexcept {
  const double wanted = (position_rad - offset_rad_) / rad_per_count_;
  // Beyond the range of any joint, and not finite numbers.
  if (!(std::abs(wanted) < kMostCounts)) return last_counts_;
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::llround(wanted)));
}

std::int32_t PositionScale::velocity_units(double velocity_rad_s) const noexcept {
  const double wanted = has_velocity() ? velocity_rad_s / velocity_rad_s_per_unit_ : 0.0;
  if (!std::isfinite(wanted)) return 0;
  return static_cast<std::int32_t>(
      std::lround(std::clamp(wanted, static_cast<double>(INT32_MIN), static_cast<double>(INT32_MAX))));
}

double PositionScale::position_rad(std::int32_t counts) noexcept {
  if (!started_) {
    total_counts_ = counts;
    started_ = true;
  } else {
    // The difference modulo 2^32 is right in both directions of a wrap.
    total_counts_ += static_cast<std::int32_t>(static_cast<std::uint32_t>(counts) -
                                               static_cast<std::uint32_t>(last_counts_));
  }
  last_counts_ = counts;
  return rad_per_count_ * static_cast<double>(total_counts_) + offset_rad_;
}

}  // namespace strainwave::cia402
