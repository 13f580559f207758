// SPDX-License-Identifier: BSD-3-Clause
// Conversion of a drive's units: counts to joint angle, per mille of rated torque to joint torque. Conversions are
// real-time safe; the constructors are not. Source: CiA 402-2, objects 6064h, 606Ch, 6071h, 6075h, 6076h, 60A9h.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

namespace strainwave::cia402 {

inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// Units of a drive, from the configuration.
struct UnitConfig {
  double counts_per_output_revolution = 0.0;  ///< > 0, counts of 6064h per turn of the joint
  int direction = 1;                          ///< -1: the drive counts in the opposite direction
  double position_offset_rad = 0.0;           ///< joint position where the drive reports 0
  double velocity_rad_s_per_unit = 0.0;  ///< of 606Ch, 60B1h and 60FFh, at the joint; 0: they are not used
  double rated_torque_unit_Nm = 1e-3;    ///< of 6076h: 1e-3 (mNm, of the profile) or 1e-6 (uNm)
  bool torque_at_joint = false;          ///< 6071h and 6076h are at the joint; else at the motor
  double gear_ratio = 1.0;               ///< motor turns per joint turn
  double torque_constant_Nm_A = 0.0;     ///< > 0, at the motor
};

/// 6076h in the drive's unit and 6075h in mA.
struct RatedValues {
  std::uint32_t torque = 0;
  std::uint32_t current_mA = 0;
};

/// Returns the rated torque at the joint. Throws InputError when 6076h in the configured unit contradicts
/// 6075h and the torque constant; the message names the unit or side that would fit. A wrong unit is a factor
/// of 1000, a wrong side the gear ratio; peak and rms amperes differ by 1.41.
double rated_joint_torque_Nm(const RatedValues& rated, const UnitConfig& units, const std::string& where);

/// Returns a warning when the rated torque at the joint is far above the joint's limit. It then suggests the
/// torque constant of the motor, since the configured one may be the joint's.
std::optional<std::string> rated_torque_doubt(double rated_Nm, const UnitConfig& units, double limit_Nm);

/// Returns a warning when the vendor of the drive (1018h:01) uses another unit of rated torque than configured.
std::optional<std::string> torque_unit_doubt(std::uint32_t vendor_id, const UnitConfig& units);

/// Compares 60A9h, the drive's unit of velocity, with the configured one; returns a line for the log. `unit` 0: the drive has no 60A9h. If
/// they differ, throws InputError with the values for a unit of the motor and of the joint. Source: CiA 303-2, codes of units.
std::string velocity_unit_text(std::uint32_t unit, const UnitConfig& units, const std::string& where);

/// Converts torque to per mille of rated torque and back.
class TorqueScale {
 public:
  TorqueScale() = default;
  /// The torque never exceeds `limit_Nm` > 0 or the range of 6071h.
  TorqueScale(double rated_Nm, int direction, double limit_Nm);

  /// Rounds to the nearest; returns 0 if the torque is not finite.
  std::int16_t per_mille(double joint_torque_Nm) const noexcept;
  double torque_Nm(std::int16_t per_mille) const noexcept { return unit_Nm_ * per_mille; }
  /// The limit for 6072h.
  std::uint16_t limit_per_mille() const noexcept { return limit_; }

 private:
  double unit_Nm_ = 0.0;  ///< torque of one per mille, with the sign of the direction
  std::uint16_t limit_ = 0;
};

/// Joint angle from a 32-bit counter that may wrap.
class PositionScale {
 public:
  PositionScale() = default;
  explicit PositionScale(const UnitConfig& units);

  double position_rad(std::int32_t counts) noexcept;
  /// Returns the angle of another count, at most half the counter's range from the last one. Does not change the state.
  double elsewhere_rad(std::int32_t counts) const noexcept;
  /// Returns the count of a joint angle, modulo 2^32; the last count if the angle is not finite.
  std::int32_t counts(double position_rad) const noexcept;
  std::int32_t last_counts() const noexcept { return last_counts_; }
  /// Returns 0 without a configured unit, or if the velocity is not finite.
  std::int32_t velocity_units(double velocity_rad_s) const noexcept;
  double velocity_rad_s(std::int32_t units) const noexcept { return velocity_rad_s_per_unit_ * units; }
  bool has_velocity() const noexcept { return velocity_rad_s_per_unit_ != 0.0; }

 private:
  double rad_per_count_ = 0.0;
  double offset_rad_ = 0.0;
  double velocity_rad_s_per_unit_ = 0.0;
  std::int64_t total_counts_ = 0;
  std::int32_t last_counts_ = 0;
  bool started_ = false;
};

}  // namespace strainwave::cia402
