// SPDX-License-Identifier: BSD-3-Clause
// A drive's units and ours: counts to joint angle, per mille of rated torque to joint torque. Conversions are
// real-time safe; building them is not. Source: CiA 402-2, objects 6064h, 606Ch, 6071h, 6075h, 6076h, 60A9h.
#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

namespace strainwave::cia402 {

inline constexpr double kTurn_rad = 2.0 * std::numbers::pi;

/// What the configuration says of a drive's units.
struct UnitConfig {
  double counts_per_output_revolution = 0.0;  ///< > 0, of 6064h per turn of the joint
  int direction = 1;                          ///< -1: the drive counts against the joint
  double position_offset_rad = 0.0;           ///< joint position where the drive says 0
  double velocity_rad_s_per_unit = 0.0;  ///< of 606Ch, 60B1h and 60FFh, at the joint; 0: they are not used
  double rated_torque_unit_Nm = 1e-3;    ///< of 6076h: 1e-3 (mNm, the profile's) or 1e-6 (uNm)
  bool torque_at_joint = false;          ///< 6071h and 6076h are at the joint; else at the motor
  double gear_ratio = 1.0;               ///< motor turns per joint turn
  double torque_constant_Nm_A = 0.0;     ///< > 0, of the motor, at the motor
};

/// 6076h in the drive's unit and 6075h in mA.
struct RatedValues {
  std::uint32_t torque = 0;
  std::uint32_t current_mA = 0;
};

/// Rated torque at the joint. Throws InputError when 6076h in the configured unit is not what 6075h and the
/// torque constant give: it names the unit or side that would fit. A wrong unit is a factor of 1000, a wrong
/// side the gear ratio; peak and rms amperes differ by 1.41.
double rated_joint_torque_Nm(const RatedValues& rated, const UnitConfig& units, const std::string& where);

/// What speaks against a rated torque at the joint that is far above the joint's limit, with the torque constant that is likely meant:
/// that of the motor, in place of the joint's.
std::optional<std::string> rated_torque_doubt(double rated_Nm, const UnitConfig& units, double limit_Nm);

/// What speaks against the unit of rated torque: the drive's maker (1018h:01) uses the other one.
std::optional<std::string> torque_unit_doubt(std::uint32_t vendor_id, const UnitConfig& units);

/// What 60A9h, the drive's unit of velocity, says of the configured one, for the log; `unit` 0: the drive has none. Throws InputError when
/// they contradict each other, with the values that fit a unit of the motor and of the joint. Source: CiA 303-2, codes of units.
std::string velocity_unit_text(std::uint32_t unit, const UnitConfig& units, const std::string& where);

/// Torque in per mille of rated torque, both ways.
class TorqueScale {
 public:
  TorqueScale() = default;
  /// `limit_Nm` > 0 is never exceeded, nor what 6071h can hold.
  TorqueScale(double rated_Nm, int direction, double limit_Nm);

  /// 0 for what is not finite. Rounded to the nearest.
  std::int16_t per_mille(double joint_torque_Nm) const noexcept;
  double torque_Nm(std::int16_t per_mille) const noexcept { return unit_Nm_ * per_mille; }
  /// For 6072h.
  std::uint16_t limit_per_mille() const noexcept { return limit_; }

 private:
  double unit_Nm_ = 0.0;  ///< of one per mille, with the direction's sign
  std::uint16_t limit_ = 0;
};

/// Joint angle from a counter of 32 bits that may wrap.
class PositionScale {
 public:
  PositionScale() = default;
  explicit PositionScale(const UnitConfig& units);

  double position_rad(std::int32_t counts) noexcept;
  /// Of another count of the same counter, at most half its range from the last one; that is not moved.
  double elsewhere_rad(std::int32_t counts) const noexcept;
  /// Of a joint angle, modulo 2^32 as the counter; the last count for what is not finite.
  std::int32_t counts(double position_rad) const noexcept;
  std::int32_t last_counts() const noexcept { return last_counts_; }
  /// 0 without a unit, and for what is not finite.
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
