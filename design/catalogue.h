// From the manufacturer's catalogue to friction parameters per temperature. Offline. Motor side, catalogue
// units (N.cm, RPM), because the costs of the fits are stated in them. Source: Zhao (2006), section 2.3,
// Tables 1 and 2.
#pragma once

#include <filesystem>
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
  bool has_starting_torque = false;      ///< or static friction; false: it was given beside the file
  std::string sha256;                    ///< of the catalogue file
};

/// Reads either of two CSV files and says which by its columns:
/// - running torque: temperature_C, torque_<speed>rpm_Ncm (two or more speeds). Coulomb and viscous friction
/// are the intercept
///   and the slope of the least-squares line over speed (above the Stribeck range); static friction is the
///   Coulomb friction plus the starting torque: the column starting_torque_Ncm where the file has it,
///   `starting_torque_Ncm` otherwise;
/// - parameters: temperature_C, viscous_Ncm_per_rpm, coulomb_Ncm, static_Ncm, used as they are, with the
/// speeds of the
///   catalogue of the source (500, 1000, 2000, 3500 RPM).
/// Throws InputError: fewer than three temperatures, not ascending, unknown columns, two of one speed, torque that
/// is not positive, friction that is none (Coulomb below 0, static below Coulomb), numbers no gear can have.
FrictionData read_catalogue(const std::filesystem::path& path, double starting_torque_Ncm);

}  // namespace strainwave
