// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/configured_joint.h"

#include "base/input_error.h"
#include "base/toml_section.h"
#include "base/units.h"
#include "control/joint/gear_catalogue.h"
#include "control/table/gain_table_json.h"

namespace strainwave {

namespace {

TorsionSpring read_spring(TomlSection& joint) {
  if (joint.has("gear")) {
    const Gear* gear = find_gear(joint.text("gear"));
    if (gear == nullptr) joint.fail("gear", "one of " + gear_names() + " is allowed");
    const double catalogue = gear->spring.stiffness_1_Nm_rad;
    return gear->spring.scaled(joint.number_or("stiffness_Nm_rad", catalogue, kPositive) / catalogue);
  }
  if (!joint.has("stiffness_torques_Nm"))
    return TorsionSpring::linear(joint.number("stiffness_Nm_rad", kPositive));
  const auto slopes = joint.numbers("stiffness_Nm_rad", kPositive);
  const auto torques = joint.numbers("stiffness_torques_Nm", kPositive);
  if (slopes.size() != 3 || torques.size() != 2)
    joint.fail("stiffness_Nm_rad", "three slopes with two stiffness_torques_Nm are allowed");
  return {slopes[0], torques[0], slopes[1], torques[1], slopes[2]};
}

void read_inertia(TomlSection& joint, ConfiguredJoint& told) {
  if (joint.text("model") != "flexible") {
    told.inertia_kgm2 = joint.number("inertia_kgm2", kPositive);
    return;
  }
  ConfiguredLink link;
  link.motor_inertia_kgm2 = joint.number("motor_inertia_kgm2", kPositive);
  link.link_inertia_kgm2 = joint.number("load_inertia_kgm2", kPositive);
  link.damping_Nms_rad = joint.number_or("damping_Nms_rad", 0.0, kNotNegative);
  link.spring = read_spring(joint);
  if (joint.has("gear"))
    link.lost_motion_rad = kUsualLostMotion * find_gear(joint.text("gear"))->lost_motion_rad;
  told.inertia_kgm2 = link.motor_inertia_kgm2 + link.link_inertia_kgm2;
  told.link = link;
}

void read_driver(TomlSection& joint, ConfiguredJoint& told) {
  TomlSection driver = joint.section_or_empty(joint.text("driver"));
  if (driver.text_or("drive_mode", "torque") != "torque")
    driver.fail("drive_mode", "\"torque\" is allowed: in another mode the ordered torque is not known");
  if (driver.has("delay_periods"))
    told.delay_periods = static_cast<int>(driver.integer("delay_periods", 0, 1000));
  if (told.link && driver.text_or("encoder_side", "motor") == "link") told.link->measured_at_link = true;
  for (const char* key : {"counts_per_joint_revolution", "counts_per_output_revolution"})
    if (driver.has(key)) told.count_rad = kTurn_rad / driver.number(key, kPositive);
}

}  // namespace

ConfiguredJoint read_configured_joint(const std::filesystem::path& config, const std::string& name) {
  TomlSection file = TomlSection::read(config);
  for (TomlSection& joint : file.sections("joint")) {
    if (joint.text("name") != name) continue;
    ConfiguredJoint told;
    read_inertia(joint, told);
    TomlSection control = joint.section_or_empty("control");
    told.gravity = GravityLoad{control.number_or("gravity_Nm", 0.0, kNotNegative),
                               control.number_or("gravity_zero_rad", 0.0, {-kTurn_rad, kTurn_rad})};
    if (joint.has("driver")) read_driver(joint, told);
    if (joint.has("table"))
      told.friction = read_gain_table(config.parent_path() / joint.text("table")).friction;
    return told;
  }
  throw InputError(config.string(), "joint.name", name, "the name of one of its joints is allowed");
}

}  // namespace strainwave
