// SPDX-License-Identifier: BSD-3-Clause
// The offset from the drive's counts to joint positions, which homing finds. Controller and homing count positions as the drive
// does; only positions from and to the outside are converted. So a joint that becomes homed does not jump, and its control law
// does not restart. Real-time safe.
//
//   joint position = drive position + offset
#pragma once

namespace strainwave {

class JointZero {
 public:
  /// With `must_be_homed` false, positions are valid from the start.
  explicit JointZero(bool must_be_homed) noexcept : state_(must_be_homed ? State::kUnknown : State::kGiven) {}

  /// Defines that the drive's position `drive_rad` is the joint position `joint_rad`.
  void set(double drive_rad, double joint_rad) noexcept {
    offset_rad_ = joint_rad - drive_rad;
    if (state_ == State::kUnknown) state_ = State::kFound;
  }
  /// Forgets a zero found by homing: counts may be missing, or a new search begins.
  void forget() noexcept {
    if (state_ == State::kFound) state_ = State::kUnknown;
  }

  /// Whether joint positions are valid.
  bool known() const noexcept { return state_ != State::kUnknown; }
  double to_joint_rad(double drive_rad) const noexcept { return drive_rad + offset_rad_; }
  double to_drive_rad(double joint_rad) const noexcept { return joint_rad - offset_rad_; }

 private:
  enum class State {
    kGiven,    ///< by the configuration; homing may correct it
    kUnknown,  ///< the drive counts from where it was switched on
    kFound     ///< by homing
  };
  State state_;
  double offset_rad_ = 0.0;
};

}  // namespace strainwave
