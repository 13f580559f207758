// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/causes.h"

namespace strainwave {

// x is the true value over the configured one, and lambda = ln x. A wrong number changes the values measured from commands and readings:
//
//   torque constant  torque is x times what is commanded:  J, Fc, Fv, K / x
//   counts           positions are x times the true ones:  J, Fv, K / x, link's motion / x
//   ratio            both:                                 J, Fv, K / x^2, Fc / x, link's motion / x
//   friction         Fc, Fv * x
//   brake            Fc alone increases
const std::vector<Cause>& causes() {  // NOLINT(readability-function-size): a table
  using enum Feature;
  static const std::vector<Cause> kCauses{
      {"wrong sign",
       "turn the sign of the torque or of the encoder: `direction` (CAN), `reversed` (GPIO) or the wiring; "
       "compare with a "
       "turn by hand",
       {},
       {kReversed}},
      {"gear ratio",
       "compare joint.gear_ratio with the gear's type plate",
       {{kInertia, -2.0}, {kViscous, -2.0}, {kCoulomb, -1.0}, {kStiffness, -2.0}, {kLinkRatio, -1.0}},
       {kTorqueLost},
       -3.0,
       3.0,
       false,
       true},
      {"encoder counts",
       "compare the encoder's counts per turn with its data sheet; a count is a quarter of a line",
       {{kInertia, -1.0}, {kViscous, -1.0}, {kStiffness, -1.0}, {kLinkRatio, -1.0}},
       {kTorqueLost}},
      {"torque constant",
       "compare torque constant and current scale of the drive with the motor's data sheet",
       {{kInertia, -1.0}, {kCoulomb, -1.0}, {kViscous, -1.0}, {kStiffness, -1.0}},
       {}},
      {"delay",
       "set delay_periods to the measured delay, and design the table for it",
       {{kDelay, 1.0}},
       {kTorqueLag},
       -12.0,
       12.0},
      {"inertia",
       "correct load_inertia_kgm2 or inertia_kgm2, and design the table for it",
       {{kInertia, 1.0}},
       {}},
      {"stiffness",
       "correct gear or stiffness_Nm_rad; look for loose screws between gear and link",
       {{kStiffness, 1.0}},
       {}},
      {"gravity",
       "set joint.control.gravity_Nm and gravity_zero_rad; or see what pushes the joint",
       {},
       {kLoad}},
      {"sagging supply",
       "measure the supply's voltage while the joint accelerates; check its current limit and cables",
       {},
       {kTorqueLost, kPowerFault}},
      {"temperature sensor wrong",
       "compare the sensor with a thermometer; check its type and its place",
       {},
       {kTemperatureDoubt},
       -60.0,
       60.0,
       true},
      {"temperature sensor unplugged", "check the sensor's plug and cable", {}, {kTemperatureSilent}},
      {"friction",
       "identify the friction anew; check grease and bearings",
       {{kCoulomb, 1.0}, {kViscous, 1.0}},
       {}},
      {"slipping coupling",
       "tighten the coupling between gear and link; check its key and clamp",
       {},
       {kLinkJumps, kLinkRatioFast}},
      {"dragging brake",
       "check that the brake opens: its voltage, wear and gap",
       {{kCoulomb, 1.0}},
       {},
       0.0,
       3.0},
      {"missing counts",
       "check the encoder's cable, plugs and supply; lower the speed or filter less",
       {{kLinkRatioFast, 1.0}, {kLinkJumps, 0.2}},
       {kCountsFault},
       0.0,
       0.3},
      {"electrical noise",
       "screen and earth the encoder's cable, and keep it away from the motor's",
       {},
       {kNoise}},
      {"no real time",
       "grant real time: see docs/installation.md; keep other loads off the processor",
       {},
       {kLoopFault}},
      {"bus overloaded",
       "lower the bus load: fewer messages, a higher bit rate; check with strainwavectl can-check",
       {{kPositionsLate, 1.0}},
       {kReadingsMissed, kBusFault},
       0.0,
       0.5},
      // A late drive delays every position by one period. On a full bus, some positions arrive in time.
      {"late drive",
       "let the drive answer at once, or raise delay_periods",
       {{kDelay, 1.0}, {kPositionsLate, 1.0}},
       {},
       0.5,
       1.5},
      {"clock trouble",
       "check the clock service of both PCs (chronyc tracking); do not set clocks by hand",
       {},
       {kClockRate, kClockJumps}},
  };
  return kCauses;
}

}  // namespace strainwave
