// SPDX-License-Identifier: BSD-3-Clause
// The plant as a TOML file, which gives the differences from a built-in joint. Offline.
//
//   base = "flexible"     ideal, limited, realistic or flexible: the source of all values that are not given
//   [joint]       inertia_kgm2 (the motor's side where there is a link), stribeck_velocity_rad_s, stribeck_exponent
//   [friction]    reference_C, decay_C,
//                 asymptote_static_Nm, asymptote_coulomb_Nm, asymptote_viscous_Nms_rad,
//                 amplitude_static_Nm, amplitude_coulomb_Nm, amplitude_viscous_Nms_rad
//   [motor]       peak_torque_Nm, stall_torque_Nm, torque_per_speed_Nms_rad, winding_loss_W_Nm2
//   [encoder]     counts_per_joint_revolution (0: ideal)
//   [thermal]     resistance_C_W, time_constant_s, sensor_time_constant_s
//   [simulation]  period_s, substeps, initial_position_rad
// The tables of sim/joint/effects_file.h are allowed as well.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "sim/joint/joint_plant.h"

namespace strainwave {

/// Reads a plant. Throws InputError naming file and line, key, value and what is allowed; unknown keys are errors.
JointPlantConfig plant_from_toml(std::string_view text, const std::string& source);

/// "ideal", "limited", "realistic", "flexible", or the path of a plant file.
JointPlantConfig plant_named(const std::string& name_or_path);

}  // namespace strainwave
