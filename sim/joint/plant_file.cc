// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/plant_file.h"

#include "base/input_error.h"
#include "base/text_file.h"
#include "base/toml_section.h"
#include "sim/joint/effects_file.h"
#include "sim/joint/reference_plant.h"

namespace strainwave {

namespace {

constexpr Range kAnyTemperature_C{-273.15, 1e4};
const std::vector<std::string> kBases = {"ideal", "limited", "realistic", "flexible"};

JointPlantConfig base_plant(const std::string& name) {
  if (name == "ideal") return ideal_plant();
  if (name == "limited") return torque_limited_plant();
  return name == "realistic" ? realistic_plant() : flexible_plant();
}

struct Key {
  const char* name;
  double* value;
  Range allowed;
};

void read_keys(TomlSection section, std::initializer_list<Key> keys) {
  for (const Key& key : keys)
    if (section.has(key.name)) *key.value = section.number(key.name, key.allowed);
  section.refuse_unknown_keys();
}

void read_joint(TomlSection& root, JointParameters& joint) {
  read_keys(root.section_or_empty("joint"),
            {{"inertia_kgm2", &joint.inertia_kgm2, {1e-9, 1e6}},
             {"stribeck_velocity_rad_s", &joint.stribeck.velocity_rad_s, kPositive},
             {"stribeck_exponent", &joint.stribeck.exponent, {0.5, 100.0}}});
  ExponentialTemperatureLaw& law = joint.friction;
  read_keys(root.section_or_empty("friction"),
            {{"reference_C", &law.reference_C, kAnyTemperature_C},
             {"decay_C", &law.decay_C, kPositive},
             {"asymptote_static_Nm", &law.asymptote.static_Nm, kNotNegative},
             {"asymptote_coulomb_Nm", &law.asymptote.coulomb_Nm, kNotNegative},
             {"asymptote_viscous_Nms_rad", &law.asymptote.viscous_Nms_rad, kNotNegative},
             {"amplitude_static_Nm", &law.amplitude.static_Nm, kNotNegative},
             {"amplitude_coulomb_Nm", &law.amplitude.coulomb_Nm, kNotNegative},
             {"amplitude_viscous_Nms_rad", &law.amplitude.viscous_Nms_rad, kNotNegative}});
}

JointPlantConfig read_plant(TomlSection& root) {
  JointPlantConfig config = base_plant(root.choice_or("base", "realistic", kBases));
  read_joint(root, config.joint);
  read_keys(root.section_or_empty("motor"),
            {{"peak_torque_Nm", &config.motor.peak_torque_Nm, kNotNegative},
             {"stall_torque_Nm", &config.motor.stall_torque_Nm, kNotNegative},
             {"torque_per_speed_Nms_rad", &config.motor.torque_per_speed_Nms_rad, kNotNegative},
             {"winding_loss_W_Nm2", &config.winding_loss_W_Nm2, kNotNegative}});
  read_keys(root.section_or_empty("encoder"),
            {{"counts_per_joint_revolution", &config.encoder.counts_per_joint_revolution, {0.0, 1e12}}});
  read_keys(root.section_or_empty("thermal"),
            {{"resistance_C_W", &config.thermal.resistance_C_W, kNotNegative},
             {"time_constant_s", &config.thermal.time_constant_s, kPositive},
             {"sensor_time_constant_s", &config.thermal.sensor_time_constant_s, kNotNegative}});
  TomlSection simulation = root.section_or_empty("simulation");
  config.period_s = simulation.number_or("period_s", config.period_s, kPositive);
  config.substeps = static_cast<int>(simulation.integer_or("substeps", config.substeps, 1, 10000));
  config.initial_position_rad =
      simulation.number_or("initial_position_rad", config.initial_position_rad, {-1e3, 1e3});
  simulation.refuse_unknown_keys();
  read_effects(root, true, config);
  root.refuse_unknown_keys();
  return config;
}

}  // namespace

JointPlantConfig plant_from_toml(std::string_view text, const std::string& source) {
  TomlSection root = TomlSection::parse(text, source);
  const JointPlantConfig config = read_plant(root);
  try {
    const JointPlant checked(config);
  } catch (const InputError& error) {
    throw InputError(source + ": " + error.what());
  }
  return config;
}

JointPlantConfig plant_named(const std::string& name_or_path) {
  for (const std::string& base : kBases)
    if (name_or_path == base) return base_plant(base);
  if (!std::filesystem::exists(name_or_path))
    throw InputError("--plant", "plant", name_or_path,
                     "must be ideal, limited, realistic, flexible or a plant file that exists");
  return plant_from_toml(read_text_file(name_or_path), name_or_path);
}

}  // namespace strainwave
