// SPDX-License-Identifier: BSD-3-Clause
// From the manufacturer's catalogue to friction parameters per temperature. Offline. Motor side, catalogue
// units (N.cm, RPM), because the costs of the fits are stated in them. Source: Zhao (2006), section 2.3,
// Tables 1 and 2.
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
      0.0;  ///< static above Coulomb friction, where the file says neither static friction nor starting torque
  bool has_starting_torque = false;  ///< the file has a column of starting torque or static friction
  std::string sha256;                ///< of the catalogue file
};

/// Reads either of two CSV files and says which by its columns:
/// - running torque: temperature_C, torque_<speed>rpm_Ncm (two or more speeds). Coulomb and viscous friction
/// are the intercept
///   and the slope of the least-squares line over speed (above the Stribeck range). Static friction is the
///   starting torque, as catalogues print it: what the motor needs to break away, Coulomb friction included.
///   It comes from the column starting_torque_Ncm. Without one `starting_torque_Ncm` is that torque at 25 degC (or at the
///   nearest temperature of the file), and static friction exceeds Coulomb friction by as much at every temperature;
///   without either it exceeds it by the 1.6 N.cm of Zhao (2006);
/// - parameters: temperature_C, viscous_Ncm_per_rpm, coulomb_Ncm, static_Ncm, used as they are, with the
/// speeds of the
///   catalogue of Zhao (2006) (500, 1000, 2000, 3500 RPM).
/// Throws InputError: fewer than three temperatures, not ascending, unknown columns, two of one speed, numbers no gear can have.
/// Also for torque that is not positive, or falls with speed at most temperatures, and for Coulomb friction below 0 or above static.
FrictionData read_catalogue(const std::filesystem::path& path,
                            std::optional<double> starting_torque_Ncm = std::nullopt);

}  // namespace strainwave
