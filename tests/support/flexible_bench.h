// SPDX-License-Identifier: BSD-3-Clause
// The joint of config/demo.toml with a spring, for tests of the loop.
#pragma once

#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {

/// Gives `joint` the link and the spring of `plant`.
inline void put_on_spring(BenchJoint& joint, const JointPlantConfig& plant) {
  joint.drive.plant = plant;
  JointControllerConfig& controller = joint.loop.controller;
  const Transmission& gear = *plant.effects.transmission;
  controller.link = {plant.joint.inertia_kgm2, gear.link_inertia_kgm2, gear.spring, gear.damping_Nms_rad, {}};
}

/// The gear's spring with a link as heavy as the motor, and an additional load that is not configured.
inline BenchJoint flexible_joint(double load_kgm2 = 0.0) {
  BenchJoint joint = demo_joint();
  put_on_spring(joint, flexible_plant());
  joint.drive.plant.effects.transmission->link_inertia_kgm2 += load_kgm2;
  return joint;
}

/// The table of the reference joint with a link of the motor's inertia.
inline const GainTable& flexible_table() {
  static const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-0.178/c4.json");
  return table;
}

}  // namespace strainwave::testing
