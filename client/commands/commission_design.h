// SPDX-License-Identifier: BSD-3-Clause
// What a commissioning's record asks of the design: arguments of strainwave-design, keys of the configuration. Not real-time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "commission/commission_record.h"
#include "commission/joint_settings.h"

namespace strainwave {

/// What the configuration says of the joint, as far as its table depends on it.
struct JointToDesign {
  std::string gear;
  std::string joint_model;
  double period_s = 0.0;
  bool homed = false;             ///< its configuration may have no gravity
  double first_target_rad = 0.0;  ///< 0.1 rad beyond the middle of its limits, or as far as they allow
  std::string prefix = ClientOptions().prefix;  ///< of its daemon
};
/// Throws InputError: no such joint, no gear of the catalogue.
JointToDesign read_joint_to_design(const std::filesystem::path& config, const std::string& joint);

/// strainwave-design gains for the measured joint:
///   link       +-10 %, stiffness +-2 %, damping +-1/3 of what is measured, or the 95 % interval where that is wider
///   delay      in whole periods, that in use, and the next one from a quarter of a period on
/// Throws InputError where the record lacks an inertia, the stiffness or the delay.
std::vector<std::string> gains_arguments(const CommissionRecord& record, const JointToDesign& joint,
                                         const std::filesystem::path& friction,
                                         const std::filesystem::path& table);

/// The keys of the joint's section that were measured, and its table. Of gravity only where the joint has some.
std::vector<JointSetting> measured_settings(const CommissionRecord& record, const JointToDesign& joint,
                                            const std::string& table);

}  // namespace strainwave
