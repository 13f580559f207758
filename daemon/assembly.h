// SPDX-License-Identifier: BSD-3-Clause
// Builds the parts that a configuration names: buses, drives with their joints' settings, and the joint data that
// admission needs. Not real-time.
#pragma once

#include <memory>
#include <vector>

#include "daemon/admission/admission.h"
#include "daemon/config/config.h"
#include "daemon/realtime/loop/loop_parts.h"

namespace strainwave {

/// Returns the buses, and for each joint its drive, settings and flight recorder, in the configuration's order.
/// Throws InputError.
LoopParts assemble_loop(const DaemonConfig& config);

/// Opens one bus and sets up every drive on it. Throws InputError.
std::unique_ptr<Fieldbus> assemble_bus(const BusConfig& bus);

/// Returns the properties of `joint` against which a gain table is judged.
ExpectedJoint expected_joint(const JointConfig& joint);
/// Returns the data of each joint that admission needs.
std::vector<JointAdmission> assemble_admission(const DaemonConfig& config);

}  // namespace strainwave
