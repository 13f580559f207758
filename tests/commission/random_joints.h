// SPDX-License-Identifier: BSD-3-Clause
// Random joints of the catalogue, with all effects of the simulation, and the results of their commissioning.
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
  double friction_scale = 1.0;  ///< ratio to the catalogue's estimate
  SimulatedActuatorConfig drive;
  ExcitationConfig excitation;
  ToldJoint told;  ///< from the catalogue alone: inertia of the wave generator, nominal spring
};

RandomJoint random_joint(std::uint64_t seed);

struct CommissionedJoint {
  std::string problem;  ///< empty: the excitation ran to its end
  double duration_s = 0.0;
  double most_speed_rad_s = 0.0;  ///< true speed of the motor
  int violations = 0;             ///< periods outside a limit, by the true motion and the torque ordered
  int faults = 0;                 ///< readings with a fault
  JointTrace trace;
};

/// Runs the excitation on the joint.
CommissionedJoint excite(const RandomJoint& joint);

/// One identified number and its true value.
struct Comparison {
  std::string quantity;
  double truth = 0.0;
  IntervalEstimate found;
  bool absent = false;

  double error() const { return absent ? 1.0 : std::abs(found.value / truth - 1.0); }

  // The delay in ms, gravity in N.m, all others as a share.
  const char* unit() const { return quantity == "delay" ? "ms" : quantity == "gravity" ? "N.m" : "%"; }
  double error_in_unit() const { return (found.value - truth) * per_unit(); }
  double half_width_in_unit() const { return found.half_width_95 * per_unit(); }

 private:
  double per_unit() const { return quantity == "delay" ? 1e3 : quantity == "gravity" ? 1.0 : 100.0 / truth; }
};

/// Compares every identified number with its true value.
std::vector<Comparison> compare(const RandomJoint& joint, const JointEstimates& found);

}  // namespace strainwave::testing
