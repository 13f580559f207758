// SPDX-License-Identifier: BSD-3-Clause
// Joints of the catalogue drawn at random, with all effects of the simulation, and what commissioning finds of them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "commission/estimates.h"
#include "commission/excitation.h"
#include "drivers/simulated_actuator.h"

namespace strainwave::testing {

struct RandomJoint {
  std::string gear;
  SimulatedActuatorConfig drive;
  ExcitationConfig excitation;
  ToldJoint told;  ///< by the catalogue alone: the wave generator's inertia and the nominal spring
};

RandomJoint random_joint(std::uint64_t seed);

struct CommissionedJoint {
  std::string problem;  ///< empty: the excitation ran to its end
  double duration_s = 0.0;
  double most_speed_rad_s = 0.0;  ///< true speed of the motor
  JointTrace trace;
};

/// Runs the excitation on the joint.
CommissionedJoint excite(const RandomJoint& joint);

/// One number that was found, and the true one.
struct Comparison {
  std::string quantity;
  double truth = 0.0;
  IntervalEstimate found;
  bool absent = false;

  double error() const { return absent ? 1.0 : std::abs(found.value / truth - 1.0); }
};

/// Everything that the goals name; delay in s, its error to be judged as it is.
std::vector<Comparison> compare(const RandomJoint& joint, const JointEstimates& found);

}  // namespace strainwave::testing
