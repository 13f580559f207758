// SPDX-License-Identifier: BSD-3-Clause
// The configured data of a joint that the doctor compares with the measurement. Joint side, SI. Not real-time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "control/friction/fuzzy_friction.h"
#include "control/joint/gravity_load.h"
#include "control/joint/torsion_spring.h"

namespace strainwave {

/// Assumed share of the catalogue's lost motion. It gives the best stiffness of joints that have a share of 0.5 to 1 (doctor_study 1 50).
inline constexpr double kUsualLostMotion = 0.6;

struct ConfiguredLink {
  double motor_inertia_kgm2 = 0.0;  ///< > 0
  double link_inertia_kgm2 = 0.0;   ///< > 0
  TorsionSpring spring;
  double damping_Nms_rad = 0.0;   ///< >= 0
  bool measured_at_link = false;  ///< the position sensor is on the link
  double lost_motion_rad = 0.0;   ///< of the gear, from side to side; 0: not known
};

/// Empty values are not known.
struct ConfiguredJoint {
  std::optional<double> inertia_kgm2;  ///< motor and load together
  std::optional<ConfiguredLink> link;  ///< of a flexible joint
  std::optional<int> delay_periods;
  std::optional<double> count_rad;  ///< size of one count at the joint
  std::optional<GravityLoad> gravity;
  std::optional<FuzzyFriction> friction;  ///< of its gain table
};

/// Reads the configuration of `joint`. Delay and counts, which a driver may derive, are read only if the file has them as numbers. The
/// daemon has checked the rest of the file. Throws InputError: unreadable, no such joint, a value out of range.
ConfiguredJoint read_configured_joint(const std::filesystem::path& config, const std::string& joint);

}  // namespace strainwave
