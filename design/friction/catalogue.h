// SPDX-License-Identifier: BSD-3-Clause
// Reads friction parameters per temperature from the manufacturer's catalogue. Offline. Motor side, catalogue
// units (N.cm, RPM), because the costs of the fits have these units. Source: Zhao (2006), section 2.3, Tables
// 1 and 2.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace strainwave {

/// Friction parameters at one temperature, motor side.
struct FrictionPoint {
  double temperature_C = 0.0;
  double motor_static_Ncm = 0.0;
  double motor_coulomb_Ncm = 0.0;
  double motor_viscous_Ncm_per_rpm = 0.0;
};

struct FrictionData {
  std::vector<FrictionPoint> points;     ///< temperatures ascending
  std::vector<double> motor_speeds_rpm;  ///< at which the catalogue states torques
  double motor_excess_Ncm =
      0.0;  ///< static minus Coulomb friction, if the file has neither static friction nor starting torque
  bool has_starting_torque = false;  ///< the file has a column of starting torque or static friction
  std::string sha256;                ///< of the catalogue file
};

/// Reads one of two kinds of CSV file, which differ in their columns:
/// - running torque: temperature_C, torque_<speed>rpm_Ncm (two or more speeds). Coulomb and viscous friction are the
///   intercept and the slope of the least-squares line over speed (above the Stribeck range). Static friction is the
///   starting torque of the catalogue: the motor's torque at breakaway, which includes Coulomb friction. It is in the
///   column starting_torque_Ncm. Without this column, `starting_torque_Ncm` is the starting torque at 25 degC (or at the
///   nearest temperature of the file). Static friction then exceeds Coulomb friction equally at every temperature.
///   Without either, it exceeds Coulomb friction by the 1.6 N.cm of Zhao (2006);
/// - parameters: temperature_C, viscous_Ncm_per_rpm, coulomb_Ncm, static_Ncm, which are used unchanged, with the speeds
///   of the catalogue of Zhao (2006) (500, 1000, 2000, 3500 RPM).
/// Throws InputError for fewer than three temperatures, or if they do not ascend, for unknown columns, for two columns of
/// one speed, and for impossible numbers. Likewise for torque that is not positive or that falls with speed at most
/// temperatures, and for Coulomb friction below 0 or above static friction.
FrictionData read_catalogue(const std::filesystem::path& path,
                            std::optional<double> starting_torque_Ncm = std::nullopt);

}  // namespace strainwave
