// SPDX-License-Identifier: BSD-3-Clause
// The alternatives to Strainwave: controllers of the motor's position that know the joint's inertia, its
// resonance and the loop's delay, but no friction. Each gets the same encoder, delay and torque limit. step()
// is real-time safe. Joint side, SI.
#pragma once

#include <memory>

#include "control/trajectory/reference_shaper.h"
#include "sim/joint/joint_plant.h"

namespace strainwave {

/// The properties of a joint that a drive's commissioning finds.
struct ServoJoint {
  double period_s = 0.001;
  double delay_periods = 0.0;
  double motor_inertia_kgm2 = 0.0;
  double inertia_kgm2 = 0.0;     ///< motor and link together
  double torque_limit_Nm = 0.0;  ///< > 0
  double resonance_rad_s = 0.0;  ///< of motor and link against each other; infinite for a rigid joint
  /// Mean of the spring's first two slopes, over which the joint moves (the resonance is that of the first); 0 for a rigid joint.
  double stiffness_Nm_rad = 0.0;
  double damping_Nms_rad = 0.0;
  double encoder_resolution_rad = 0.0;  ///< of the motor's encoder; 0: exact
  double filter_s = 0.0;                ///< delay that a notch of the torque adds to slower signals
  /// Sum of the loop's small times: the torque's delay, half a period of hold, and half a period of the velocity difference.
  double small_times_s() const noexcept { return (delay_periods + 1.0) * period_s; }
};

ServoJoint servo_joint(const JointPlantConfig& plant);

/// Frequency in rad/s at which the velocity loop of a drive on this joint crosses unity gain, by the symmetrical optimum:
///   1 / (2 T),  T: the loop's small times and its notch
/// It is at most half of the resonance, beyond which the motor no longer carries its load. There the gain, made for both inertias, acts on
/// the motor alone, and crosses unity again at J / Jm times the frequency. For a margin, this second crossover is at most 1 / T; a notch
/// does not delay it there. Sources: Schroeder (2009), by the user's guide of Modelica's DriveControl ("Speed controller": Ti = 4 T,
/// Kp = J / (2 T)); Beckhoff's AX5000 manual ("Adjustment procedure": a factor of 2 to 3 below the resonance).
double velocity_bandwidth_rad_s(const ServoJoint& joint) noexcept;

class ServoPeer {
 public:
  virtual ~ServoPeer() = default;
  ServoPeer() = default;
  ServoPeer(const ServoPeer&) = delete;
  ServoPeer& operator=(const ServoPeer&) = delete;
  /// Returns the torque for this period, from the motor's present reference and its measured position.
  virtual double step(const Reference& reference, double joint_position_rad) noexcept = 0;
  /// Forgets everything; the joint rests at `joint_position_rad`.
  virtual void reset(double joint_position_rad) noexcept = 0;
};

}  // namespace strainwave
