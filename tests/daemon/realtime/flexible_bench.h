// The joint of the demo on a spring, for tests of the loop.
#pragma once

#include "control/gain_table_json.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {

/// A link as heavy as the motor on the gear's spring, of which the controller is told or not.
inline BenchJoint flexible_joint(bool told = true, double load_kgm2 = 0.0) {
  BenchJoint joint = demo_joint();
  joint.drive.plant = flexible_plant();
  const Transmission& gear = *joint.drive.plant.effects.transmission;
  JointControllerConfig& controller = joint.loop.controller;
  controller.rigid = false;
  controller.use_observer = false;
  controller.use_landing = false;
  if (told)
    controller.link = {
        joint.drive.plant.joint.inertia_kgm2, gear.link_inertia_kgm2, gear.spring, gear.damping_Nms_rad, {}};
  joint.drive.plant.effects.transmission->link_inertia_kgm2 += load_kgm2;
  return joint;
}

inline const GainTable& flexible_table() {
  static const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-0.178/c4.json");
  return table;
}

}  // namespace strainwave::testing
