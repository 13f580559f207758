// SPDX-License-Identifier: BSD-3-Clause
// Turns a commissioning record into arguments of strainwave-design and keys of the configuration. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "commission/commission_record.h"
#include "commission/joint_settings.h"

namespace strainwave {

/// The part of a joint's configuration that its table depends on.
struct JointToDesign {
  std::string gear;
  std::string joint_model;
  double period_s = 0.0;
  bool homed = false;             ///< if homed, the configuration gets no gravity
  double first_target_rad = 0.0;  ///< middle of its limits + 0.1 rad, or + a quarter of their width if less
  std::string prefix = ClientOptions().prefix;  ///< prefix of its daemon
};
/// Throws InputError if there is no such joint, or no gear of the catalogue.
JointToDesign read_joint_to_design(const std::filesystem::path& config, const std::string& joint);

/// Arguments of strainwave-design gains for the measured joint:
///   link       +-10 %, stiffness +-2 %, damping +-1/3 of the measured value, or the 95 % interval where it is wider
///   delay      whole periods: the one in use; also the next one if the measured delay exceeds it by a quarter of a period
/// Throws InputError where the record lacks an inertia, the stiffness or the delay.
std::vector<std::string> gains_arguments(const CommissionRecord& record, const JointToDesign& joint,
                                         const std::filesystem::path& friction,
                                         const std::filesystem::path& table);

/// The measured keys of the joint's section, and its table. Gravity is included only if the measurement shows some.
std::vector<JointSetting> measured_settings(const CommissionRecord& record, const JointToDesign& joint,
                                            const std::string& table);

}  // namespace strainwave
