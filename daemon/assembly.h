// SPDX-License-Identifier: BSD-3-Clause
// Makes what a configuration names: buses, drives with their joints' settings, and what admission must know of
// a joint. Not real-time.
#pragma once

#include <memory>
#include <vector>

#include "daemon/admission/admission.h"
#include "daemon/config/config.h"
#include "daemon/realtime/loop/loop_parts.h"

namespace strainwave {

/// The buses, and of each joint the drive, its settings and its flight recorder, all in the
/// configuration's order. Throws InputError.
LoopParts assemble_loop(const DaemonConfig& config);

/// One bus, with every drive on it set up. Throws InputError.
std::unique_ptr<Fieldbus> assemble_bus(const BusConfig& bus);

/// What a table for `joint` is judged by.
ExpectedJoint expected_joint(const JointConfig& joint);
/// What admission must know of each joint.
std::vector<JointAdmission> assemble_admission(const DaemonConfig& config);

}  // namespace strainwave
