// SPDX-License-Identifier: BSD-3-Clause
// What the drive's counts mean: the offset that homing finds. Controller and homing count positions as the drive does; what
// comes from outside and goes there is moved by this. So a joint that becomes homed does not jump, and nothing in the control
// law begins anew. Real-time safe.
//
//   joint position = drive position + offset
#pragma once

namespace strainwave {

class JointZero {
 public:
  /// With `must_be_homed` false positions are true from the start.
  explicit JointZero(bool must_be_homed) noexcept : state_(must_be_homed ? State::kUnknown : State::kGiven) {}

  /// The place that the drive counts as `drive_rad` is `joint_rad`.
  void set(double drive_rad, double joint_rad) noexcept {
    offset_rad_ = joint_rad - drive_rad;
    if (state_ == State::kUnknown) state_ = State::kFound;
  }
  /// Counts may be missing, or a search begins.
  void forget() noexcept {
    if (state_ == State::kFound) state_ = State::kUnknown;
  }

  /// Whether positions mean what the configuration says.
  bool known() const noexcept { return state_ != State::kUnknown; }
  double to_joint_rad(double drive_rad) const noexcept { return drive_rad + offset_rad_; }
  double to_drive_rad(double joint_rad) const noexcept { return joint_rad - offset_rad_; }

 private:
  enum class State {
    kGiven,    ///< by the configuration; homing may correct it
    kUnknown,  ///< counts from where the drive was switched on
    kFound     ///< by homing
  };
  State state_;
  double offset_rad_ = 0.0;
};

}  // namespace strainwave
