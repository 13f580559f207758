// SPDX-License-Identifier: BSD-3-Clause
// What a user could take in the place of Strainwave: a controller of the motor's position that knows the joint's inertia, its
// resonance and the loop's delay, and no friction. Each gets the same encoder, delay and torque limit. step() is real-time safe.
// Joint side, SI.
#pragma once

#include <memory>

#include "control/trajectory/reference_shaper.h"
#include "sim/joint/joint_plant.h"

namespace strainwave {

/// What a drive's commissioning finds out of a joint.
struct ServoJoint {
  double period_s = 0.001;
  double delay_periods = 0.0;
  double motor_inertia_kgm2 = 0.0;
  double inertia_kgm2 = 0.0;     ///< motor and link together
  double torque_limit_Nm = 0.0;  ///< > 0
  double resonance_rad_s = 0.0;  ///< of motor and link against each other; infinite of a rigid joint
  /// Mean of the spring's first two slopes, on which it moves (the resonance is that of the first); 0 of a rigid joint.
  double stiffness_Nm_rad = 0.0;
  double damping_Nms_rad = 0.0;
  double encoder_resolution_rad = 0.0;  ///< of the motor's; 0: exact
  double filter_s = 0.0;                ///< by which a notch of the torque delays what is slower than it
  /// Small times of the loop together: the torque's delay, half a period that it is held, half of the difference that is the velocity.
  double small_times_s() const noexcept { return (delay_periods + 1.0) * period_s; }
};

ServoJoint servo_joint(const JointPlantConfig& plant);

/// Rad/s at which the velocity loop of a drive on this joint crosses unity gain: that of the symmetrical optimum,
///   1 / (2 T),  T: the loop's small times and its notch
/// and no more than half of the resonance, beyond which the motor no longer carries its load. There the gain, made for both, acts on the
/// motor alone and crosses unity again, J / Jm farther up: by 1 / T at most, for a margin; a notch does not delay it there. Sources:
/// Schroeder (2009), by the user's guide of Modelica's DriveControl ("Speed controller": Ti = 4 T, Kp = J / (2 T)); Beckhoff's AX5000
/// manual ("Adjustment procedure": a factor of 2 to 3 below the resonance).
double velocity_bandwidth_rad_s(const ServoJoint& joint) noexcept;

class ServoPeer {
 public:
  virtual ~ServoPeer() = default;
  ServoPeer() = default;
  ServoPeer(const ServoPeer&) = delete;
  ServoPeer& operator=(const ServoPeer&) = delete;
  /// Torque for this period: where the motor is to be now, how fast and with which acceleration, and where it is read.
  virtual double step(const Reference& reference, double joint_position_rad) noexcept = 0;
  /// Forgets everything; the joint rests at `joint_position_rad`.
  virtual void reset(double joint_position_rad) noexcept = 0;
};

}  // namespace strainwave
