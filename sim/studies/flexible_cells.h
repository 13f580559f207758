// SPDX-License-Identifier: BSD-3-Clause
// The flexible joints that the controllers are tried on: a grid of links, stiffness, damping, temperatures and steps;
// further effects, alone and together; and joints drawn at random. Offline. Source: docs/flexible-joint.md.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/joint/joint_plant.h"

namespace strainwave {

/// One joint and the step that it makes.
struct FlexibleCell {
  double link_inertia_kgm2 = 0.0;
  double stiffness_scale = 1.0;  ///< scale of the gear's spring
  double damping_ratio = 0.0;    ///< of the free-free oscillation
  double temperature_C = 0.0;
  double step_rad = 0.0;
  std::string effect = "none";  ///< additional effect of the joint
  JointPlantConfig nominal;     ///< the model that the controllers know
  JointPlantConfig plant;       ///< the plant that they run on
  double duration_s = 2.0;      ///< duration of a run; its last quarter counts as rest
};

/// The grid of docs/flexible-joint.md.
std::vector<FlexibleCell> flexible_grid();
/// The grid at 3 % damping and the gear's own stiffness, with each effect alone and all together.
std::vector<FlexibleCell> effect_grid();
/// JL / Jm 0.3, 1, 3 on two stiffnesses with 2 % damping. On these joints the first controller of this project oscillated.
std::vector<FlexibleCell> first_grid();
/// The joints of the grid with links up to 0.267 kg m2, first with the right model (effect "none"). In the cells
/// after it, one or several quantities are wrong or missing in the model: `nominal` differs from the joint.
std::vector<FlexibleCell> wrongly_configured_grid();
/// An effect of that grid.
inline constexpr const char* kOneMorePeriod = "one period of delay more";
/// The cells of wrongly_configured_grid() whose links are in the boxes of the shipped tables: right model, and one more period of delay.
std::vector<FlexibleCell> late_grid();
/// `count` joints of random_joints() with their effects, each twice: with the right model (effect "none"),
/// and with load, stiffness and friction wrong by up to 30, 25 and 30 %.
std::vector<FlexibleCell> wrongly_configured_joints(int count, std::uint64_t seed);
/// Joints drawn at random around the grid, with effects. Each cell depends only on the seed and its number.
std::vector<FlexibleCell> random_joints(int count, std::uint64_t seed);

}  // namespace strainwave
