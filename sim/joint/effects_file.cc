// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/effects_file.h"

#include <algorithm>
#include <numbers>
#include <string>

#include "base/printable.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

namespace {

constexpr Range kPhase_rad{-std::numbers::pi, std::numbers::pi};

const Gear* read_gear(TomlSection& section, bool gear_sets_ratio, JointEffects& effects) {
  if (!section.has("gear")) return nullptr;
  const Gear* gear = find_gear(section.text("gear"));
  if (gear == nullptr) section.fail("gear", "one of " + gear_names() + " is allowed");
  if (gear_sets_ratio) effects.gear_ratio = gear->ratio;
  if (gear->ratio != effects.gear_ratio)
    section.fail("gear",
                 "a gear with the joint's ratio of " + number_text(effects.gear_ratio) + " is allowed");
  return gear;
}

void read_spring(TomlSection section, const Gear* gear, Transmission& transmission) {
  TorsionSpring& spring = transmission.spring;
  if (gear != nullptr) spring = gear->spring;
  const auto stiffness = [&](const char* key, double& value) {
    value = value > 0.0 ? section.number_or(key, value, kPositive) : section.number(key, kPositive);
  };
  stiffness("stiffness_1_Nm_rad", spring.stiffness_1_Nm_rad);
  // A spring without a gear may give only its first slope, which then holds for all. A spring without any slope keeps its values.
  if (gear == nullptr && section.has("stiffness_1_Nm_rad"))
    spring.stiffness_2_Nm_rad = spring.stiffness_3_Nm_rad = spring.stiffness_1_Nm_rad;
  spring.torque_1_Nm = section.number_or("torque_1_Nm", spring.torque_1_Nm, kNotNegative);
  stiffness("stiffness_2_Nm_rad", spring.stiffness_2_Nm_rad);
  spring.torque_2_Nm = section.number_or("torque_2_Nm", std::max(spring.torque_1_Nm, spring.torque_2_Nm),
                                         {spring.torque_1_Nm, kNotNegative.max});
  stiffness("stiffness_3_Nm_rad", spring.stiffness_3_Nm_rad);
  // A slope outside every range of torque would be ignored, so it is refused.
  if (section.has("stiffness_2_Nm_rad") && spring.torque_2_Nm <= spring.torque_1_Nm)
    section.fail("stiffness_2_Nm_rad",
                 "it is allowed only with torque_1_Nm below torque_2_Nm: it is the slope between them");
  if (section.has("stiffness_3_Nm_rad") && spring.torque_2_Nm <= 0.0)
    section.fail("stiffness_3_Nm_rad", "it is allowed only with torque_2_Nm: it is the slope above it");
  spring = spring.scaled(section.number_or("scale", 1.0, {0.01, 100.0}));
  transmission.damping_Nms_rad =
      section.number_or("damping_Nms_rad", transmission.damping_Nms_rad, kNotNegative);
  transmission.lost_motion.width_rad =
      section.number_or("lost_motion_rad", transmission.lost_motion.width_rad, {0.0, 0.1});
  section.refuse_unknown_keys();
}

KinematicError read_kinematic_error(TomlSection section, double gear_ratio) {
  KinematicError error;
  error.amplitude_rad[0] = section.number_or("once_rad", 0.0, {0.0, 0.01});
  error.phase_rad[0] = section.number_or("once_phase_rad", 0.0, kPhase_rad);
  error.amplitude_rad[1] = section.number_or("twice_rad", 0.0, {0.0, 0.01});
  error.phase_rad[1] = section.number_or("twice_phase_rad", 0.0, kPhase_rad);
  section.refuse_unknown_keys();
  const double steepest = -gear_ratio * error.least_slope();
  if (steepest >= 1.0)
    section.fail(error.amplitude_rad[0] >= 2.0 * error.amplitude_rad[1] ? "once_rad" : "twice_rad",
                 "less is allowed: with " + number_text(gear_ratio) +
                     " motor turns per joint turn, the link would turn back while the motor goes on; "
                     "multiply once_rad and twice_rad by less than " +
                     number_text(1.0 / steepest));
  return error;
}

void read_transmission(TomlSection& section, bool gear_sets_ratio, JointEffects& effects) {
  const Gear* gear = read_gear(section, gear_sets_ratio, effects);
  if (!section.has("link")) {
    for (const char* key : {"gear", "spring", "kinematic_error"})
      if (section.has(key) && !effects.transmission)
        section.fail(key, "a gear's spring needs link.inertia_kgm2, the inertia of the link behind it");
    if (!effects.transmission) return;
  }
  Transmission transmission = effects.transmission.value_or(Transmission{});
  TomlSection link = section.section_or_empty("link");
  transmission.link_inertia_kgm2 =
      effects.transmission ? link.number_or("inertia_kgm2", transmission.link_inertia_kgm2, {1e-6, 1e4})
                           : link.number("inertia_kgm2", {1e-6, 1e4});
  transmission.link_coulomb_Nm = link.number_or("coulomb_Nm", transmission.link_coulomb_Nm, kNotNegative);
  transmission.link_viscous_Nms_rad =
      link.number_or("viscous_Nms_rad", transmission.link_viscous_Nms_rad, kNotNegative);
  link.refuse_unknown_keys();
  if (gear == nullptr && !effects.transmission && !section.has("spring"))
    section.fail("link", "a link needs a gear, or a spring of its own");
  read_spring(section.section_or_empty("spring"), gear, transmission);
  if (section.has("kinematic_error"))
    transmission.kinematic_error =
        read_kinematic_error(section.section("kinematic_error"), effects.gear_ratio);
  effects.transmission = transmission;
}

void read_drive(TomlSection section, JointPlantConfig& plant) {
  DriveEffects& drive = plant.effects.drive;
  drive.current_loop_s = section.number_or("current_loop_s", drive.current_loop_s, {0.0, 1.0});
  drive.ripple_share = section.number_or("ripple_share", drive.ripple_share, {0.0, 0.99});
  drive.ripple_per_motor_turn =
      section.number_or("ripple_per_motor_turn", drive.ripple_per_motor_turn, {0.0, 1000.0});
  plant.delay.periods = section.number_or("delay_periods", plant.delay.periods, {0.0, kMaxDelayPeriods});
  plant.delay.jitter_periods = section.number_or("jitter_periods", plant.delay.jitter_periods, {0.0, 4.0});
  plant.delay.seed = static_cast<std::uint64_t>(
      section.integer_or("seed", static_cast<std::int64_t>(plant.delay.seed), 0, INT64_MAX));
  section.refuse_unknown_keys();
}

void read_link_encoder(TomlSection section, JointPlantConfig& plant) {
  plant.link_encoder.counts_per_joint_revolution = section.number("counts_per_joint_revolution", {1.0, 1e12});
  if (section.boolean_or("feedback", false)) plant.feedback = EncoderSide::kLink;
  section.refuse_unknown_keys();
}

}  // namespace

void read_effects(TomlSection& section, bool gear_sets_ratio, JointPlantConfig& plant) {
  JointEffects& effects = plant.effects;
  read_transmission(section, gear_sets_ratio, effects);
  TomlSection sliding = section.section_or_empty("sliding");
  effects.friction.transmitted_share =
      sliding.number_or("transmitted_share", effects.friction.transmitted_share, {0.0, 1.0});
  effects.friction.presliding_rad =
      sliding.number_or("presliding_rad", effects.friction.presliding_rad, {0.0, 0.1});
  effects.friction.direction_share =
      sliding.number_or("direction_share", effects.friction.direction_share, {-0.99, 0.99});
  sliding.refuse_unknown_keys();
  read_drive(section.section_or_empty("drive"), plant);
  TomlSection gravity = section.section_or_empty("gravity");
  effects.gravity.torque_Nm = gravity.number_or("torque_Nm", effects.gravity.torque_Nm, {0.0, 1e6});
  effects.gravity.zero_rad = gravity.number_or("zero_rad", effects.gravity.zero_rad, {-1e3, 1e3});
  gravity.refuse_unknown_keys();
  if (section.has("contact")) {
    TomlSection contact = section.section("contact");
    // The link starts at the motor's position, and not inside the obstacle.
    effects.contact.position_rad = contact.number("position_rad", {plant.initial_position_rad, 1e3});
    effects.contact.stiffness_Nm_rad = contact.number("stiffness_Nm_rad", kPositive);
    effects.contact.damping_Nms_rad = contact.number_or("damping_Nms_rad", 0.0, kNotNegative);
    contact.refuse_unknown_keys();
  }
  if (section.has("link_encoder")) read_link_encoder(section.section("link_encoder"), plant);
}

}  // namespace strainwave
