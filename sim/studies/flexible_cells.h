// SPDX-License-Identifier: BSD-3-Clause
// The joints with a spring that controllers are tried on: a grid of links, stiffness, damping, temperatures and steps, each further
// effect alone and all together, and joints drawn at random. Offline. Source: docs/flexible-joint.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/joint/joint_plant.h"

namespace strainwave {

/// One joint with one step to make.
struct FlexibleCell {
  double link_inertia_kgm2 = 0.0;
  double stiffness_scale = 1.0;  ///< of the gear's spring
  double damping_ratio = 0.0;    ///< of the free-free swing
  double temperature_C = 0.0;
  double step_rad = 0.0;
  std::string effect = "none";  ///< what the joint has besides
  JointPlantConfig nominal;     ///< what the controllers know
  JointPlantConfig plant;       ///< what they run on
  double duration_s = 2.0;      ///< of a run; its last quarter is rest
};

/// The grid of docs/flexible-joint.md.
std::vector<FlexibleCell> flexible_grid();
/// The grid at 3 % damping and the gear's own stiffness, with each effect alone and all together.
std::vector<FlexibleCell> effect_grid();
/// JL / Jm 0.3, 1, 3 on two stiffnesses with 2 % damping: where the first controller of this project was found to oscillate.
std::vector<FlexibleCell> first_grid();
/// The joints of the grid with links up to 0.267 kg m2, first with the right model (effect "none"). Then each has one thing or several
/// that are wrong or missing in the model: `nominal` differs from the joint.
std::vector<FlexibleCell> wrongly_configured_grid();
/// Effect of that grid.
inline constexpr const char* kOneMorePeriod = "one period of delay more";
/// Those joints of wrongly_configured_grid() that the boxes of the shipped tables hold, with the right model and with one period of delay more.
std::vector<FlexibleCell> late_grid();
/// `count` joints of random_joints, effects and all, each twice: with the right model (effect "none"), and with load, stiffness and
/// friction wrong by up to 30, 25 and 30 %.
std::vector<FlexibleCell> wrongly_configured_joints(int count, std::uint64_t seed);
/// Joints drawn at random around the grid, effects included; the cell depends on the seed and its number alone.
std::vector<FlexibleCell> random_joints(int count, std::uint64_t seed);

}  // namespace strainwave
