// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_model.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/printable.h"
#include "base/units.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

namespace {

// Largest ratio of the link's inertia to the motor's, and the reverse. Beyond it, both move like one inertia.
constexpr double kLargestRatio = 1e3;
// Largest share of critical damping that the planned motion compensates (tests/control/motor_plan_test.cc). Gears have a tenth of it.
constexpr double kMostDamping = 0.5;

// A measured K1 that differs from the catalogue's by a larger factor belongs to another gear.
constexpr double kMostMeasured = 2.0;

constexpr const char* kGearLine =
    "gear = \"csf-17-50\" (its catalogue name; or stiffness_Nm_rad = K1 of the gear's data sheet)";
constexpr const char* kMotorLine =
    "motor_inertia_kgm2 = 0.089 (at the joint: the rotor inertia of the data sheet times gear_ratio squared)";
constexpr const char* kLoadLine =
    "load_inertia_kgm2 = 0.1 (of the link and what it carries: mass times lever squared)";

void require_model(const TomlSection& joint) {
  if (joint.has("model")) return;
  std::string lines = "for a joint with a gear the missing lines are model = \"flexible\"";
  for (const char* line : {kGearLine, kMotorLine, kLoadLine}) lines.append(", ").append(line);
  joint.fail("model",
             lines +
                 "; without a gear between motor and load they are model = \"rigid\", inertia_kgm2 = 0.089 "
                 "(of motor and load together)");
}

// Reports all missing keys at once, at the place of the first. With `assumed` the inertias may be missing.
void require_flexible_keys(const TomlSection& joint, bool assumed) {
  const char* first = nullptr;
  std::string lines;
  const auto require = [&](const char* key, bool given, const char* line) {
    if (given) return;
    if (first == nullptr) first = key;
    lines.append(lines.empty() ? "" : ", ").append(line);
  };
  require("gear", joint.has("gear") || joint.has("stiffness_Nm_rad"), kGearLine);
  require("motor_inertia_kgm2", assumed || joint.has("motor_inertia_kgm2"), kMotorLine);
  require("load_inertia_kgm2", assumed || joint.has("load_inertia_kgm2"), kLoadLine);
  if (first != nullptr) joint.fail(first, "model = \"flexible\" needs it; the missing lines are " + lines);
}

void refuse_keys(const TomlSection& joint, const std::vector<const char*>& keys, const std::string& why) {
  for (const char* key : keys)
    if (joint.has(key)) joint.fail(key, why);
}

TorsionSpring named_spring(TomlSection& joint, PlantIdentity& plant) {
  refuse_keys(joint, {"stiffness_torques_Nm"},
              "it is allowed only without gear, since the catalogue has the torques: delete one of the two");
  const Gear* gear = find_gear(joint.text("gear"));
  if (gear == nullptr)
    joint.fail("gear", "a gear of the catalogue is allowed: " + gear_names() +
                           "; for another give stiffness_Nm_rad in its place");
  if (std::abs(gear->ratio - plant.gear_ratio) > 1e-6 * gear->ratio)
    // Reading goes on, so that all errors of a file are reported at once.
    joint.note_error(joint.place("gear") + ": this gear's ratio is " + number_text(gear->ratio) +
                     ", but joint.gear_ratio = " + number_text(plant.gear_ratio) +
                     ": correct joint.gear_ratio, or name another gear");
  plant.gear = FixedString<32>(gear->name);
  if (!joint.has("stiffness_Nm_rad")) return gear->spring;
  // The measured K1 scales all slopes of the catalogue's spring alike.
  const double catalogue = gear->spring.stiffness_1_Nm_rad;
  return gear->spring.scaled(
      joint.number("stiffness_Nm_rad", {catalogue / kMostMeasured, catalogue * kMostMeasured}) / catalogue);
}

TorsionSpring measured_spring(TomlSection& joint) {
  if (!joint.has("stiffness_torques_Nm"))
    return TorsionSpring::linear(joint.number("stiffness_Nm_rad", kPositive));
  const std::vector<double> slopes = joint.numbers("stiffness_Nm_rad", kPositive);
  const std::vector<double> torques = joint.numbers("stiffness_torques_Nm", kPositive);
  if (slopes.size() != 3)
    joint.fail("stiffness_Nm_rad", "three slopes, [K1, K2, K3], are allowed with stiffness_torques_Nm");
  if (torques.size() != 2 || torques[0] >= torques[1])
    joint.fail("stiffness_torques_Nm",
               "two rising torques are allowed: [T1, T2], above which the slopes are K2 and K3");
  return {slopes[0], torques[0], slopes[1], torques[1], slopes[2]};
}

LinkModel read_flexible(TomlSection& joint, ConfigUse use, JointConfig& made) {
  PlantIdentity& plant = made.plant;
  refuse_keys(joint, {"inertia_kgm2"},
              "it is allowed only with model = \"rigid\": a flexible joint has motor_inertia_kgm2 and "
              "load_inertia_kgm2, since a spring is between them");
  const bool assumed = use == ConfigUse::kCommission && joint.has("gear");
  require_flexible_keys(joint, assumed);
  made.motor_inertia_assumed = assumed && !joint.has("motor_inertia_kgm2");
  made.load_inertia_assumed = assumed && !joint.has("load_inertia_kgm2");
  LinkModel link;
  link.spring = joint.has("gear") ? named_spring(joint, plant) : measured_spring(joint);
  link.motor_inertia_kgm2 =
      made.motor_inertia_assumed
          ? find_gear(plant.gear.view())->wave_generator_inertia_kgm2 * plant.gear_ratio * plant.gear_ratio
          : joint.number("motor_inertia_kgm2", kPositive);
  link.link_inertia_kgm2 = made.load_inertia_assumed
                               ? link.motor_inertia_kgm2
                               : joint.number("load_inertia_kgm2", {link.motor_inertia_kgm2 / kLargestRatio,
                                                                    link.motor_inertia_kgm2 * kLargestRatio});
  link.damping_Nms_rad =
      joint.number_or("damping_Nms_rad", 0.0,
                      {0.0, structural_damping_Nms_rad(link.motor_inertia_kgm2, link.link_inertia_kgm2,
                                                       link.spring.stiffness_1_Nm_rad, kMostDamping)});
  plant.inertia_kgm2 = link.motor_inertia_kgm2 + link.link_inertia_kgm2;
  return link;
}

void read_rigid(TomlSection& joint, PlantIdentity& plant) {
  refuse_keys(joint,
              {"gear", "stiffness_Nm_rad", "stiffness_torques_Nm", "motor_inertia_kgm2", "load_inertia_kgm2",
               "damping_Nms_rad"},
              "it is allowed only with model = \"flexible\": a rigid joint has no spring, and one inertia, "
              "inertia_kgm2");
  plant.inertia_kgm2 = joint.number("inertia_kgm2", kPositive);
}

}  // namespace

void read_model(TomlSection& section, ConfigUse use, JointConfig& joint) {
  require_model(section);
  if (section.choice("model", {"flexible", "rigid"}) == "flexible") {
    joint.loop.controller.link = read_flexible(section, use, joint);
  } else {
    read_rigid(section, joint.plant);
  }
}

// The gravity torque is m g l sin(position - zero).
void read_gravity(TomlSection& control, JointControllerConfig& controller) {
  if (!control.has("gravity_Nm")) {
    if (control.has("gravity_zero_rad"))
      control.fail("gravity_zero_rad", "it is allowed only with gravity_Nm");
    return;
  }
  controller.gravity.torque_Nm = control.number("gravity_Nm", {0.0, controller.torque_limit_Nm});
  controller.gravity.zero_rad = control.number("gravity_zero_rad", {-kTurn_rad, kTurn_rad});
}

}  // namespace strainwave
