// SPDX-License-Identifier: BSD-3-Clause
// The effects of a joint as tables of a TOML file. A plant file and [joint.simulated] use the same keys. Offline.
//
//   gear = "csf-17-50"     names the spring and the ratio; see data/gears.csv
//   [link]             inertia_kgm2 (makes the joint flexible), coulomb_Nm, viscous_Nms_rad
//   [spring]           stiffness_1_Nm_rad, torque_1_Nm, stiffness_2_Nm_rad, torque_2_Nm, stiffness_3_Nm_rad, scale,
//                      damping_Nms_rad, lost_motion_rad
//   [kinematic_error]  once_rad, once_phase_rad, twice_rad, twice_phase_rad (per motor turn)
//   [sliding]          transmitted_share, presliding_rad, direction_share
//   [drive]            current_loop_s, ripple_share, ripple_per_motor_turn, delay_periods, jitter_periods, seed
//   [gravity]          torque_Nm, zero_rad
//   [contact]          position_rad, stiffness_Nm_rad, damping_Nms_rad
//   [link_encoder]     counts_per_joint_revolution, feedback (true: the drive reports the link's position)
#pragma once

#include "base/toml_section.h"
#include "sim/joint/joint_plant.h"

namespace strainwave {

/// Reads these tables from `section` into `plant`. A gear with another ratio than `plant.effects.gear_ratio` is refused, or
/// replaces that ratio if `gear_sets_ratio`. Throws InputError naming file, line, key, value and what is allowed.
void read_effects(TomlSection& section, bool gear_sets_ratio, JointPlantConfig& plant);

}  // namespace strainwave
