#include "sim/joint/plant_file.h"

#include <algorithm>
#include <limits>
#include <map>

#include "base/input_error.h"
#include "base/text_file.h"
#include "base/toml_section.h"
#include "sim/joint/setting.h"

namespace strainwave {

namespace {

using Fields = std::map<std::string, double*>;

std::map<std::string, Fields> sections_of(JointPlantConfig& c) {
  FrictionParameters& asymptote = c.joint.friction.asymptote;
  FrictionParameters& amplitude = c.joint.friction.amplitude;
  return {{"joint",
           {{"inertia_kgm2", &c.joint.inertia_kgm2},
            {"stribeck_velocity_rad_s", &c.joint.stribeck.velocity_rad_s},
            {"stribeck_exponent", &c.joint.stribeck.exponent}}},
          {"friction",
           {{"reference_C", &c.joint.friction.reference_C},
            {"decay_C", &c.joint.friction.decay_C},
            {"asymptote_static_Nm", &asymptote.static_Nm},
            {"asymptote_coulomb_Nm", &asymptote.coulomb_Nm},
            {"asymptote_viscous_Nms_rad", &asymptote.viscous_Nms_rad},
            {"amplitude_static_Nm", &amplitude.static_Nm},
            {"amplitude_coulomb_Nm", &amplitude.coulomb_Nm},
            {"amplitude_viscous_Nms_rad", &amplitude.viscous_Nms_rad}}},
          {"motor",
           {{"peak_torque_Nm", &c.motor.peak_torque_Nm},
            {"stall_torque_Nm", &c.motor.stall_torque_Nm},
            {"torque_per_speed_Nms_rad", &c.motor.torque_per_speed_Nms_rad},
            {"winding_loss_W_Nm2", &c.winding_loss_W_Nm2}}},
          {"encoder", {{"counts_per_joint_revolution", &c.encoder.counts_per_joint_revolution}}},
          {"thermal",
           {{"resistance_C_W", &c.thermal.resistance_C_W},
            {"time_constant_s", &c.thermal.time_constant_s},
            {"sensor_time_constant_s", &c.thermal.sensor_time_constant_s}}},
          {"simulation", {{"period_s", &c.period_s}, {"initial_position_rad", &c.initial_position_rad}}}};
}

JointPlantConfig base_plant(TomlSection& file) {
  std::vector<std::string> names;
  for (const Setting setting : kSettings) names.emplace_back(name(setting));
  const std::string base = file.choice_or("base", std::string(name(Setting::kRealistic)), names);
  const auto found = std::find(names.begin(), names.end(), base);
  return setting_plant(kSettings[static_cast<std::size_t>(found - names.begin())]);
}

void read_section(TomlSection section, const std::string& section_name, const Fields& fields,
                  JointPlantConfig& config) {
  constexpr Range kAnyNumber{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
  constexpr std::int64_t kMost = 1'000'000;
  for (const auto& [key, value] : fields) *value = section.number_or(key, *value, kAnyNumber);
  if (section_name == "simulation") {
    config.substeps = static_cast<int>(section.integer_or("substeps", config.substeps, 0, kMost));
    config.delay_samples =
        static_cast<int>(section.integer_or("delay_samples", config.delay_samples, 0, kMost));
  }
  section.refuse_unknown_keys();
}

}  // namespace

JointPlantConfig plant_from_toml(std::string_view text, const std::string& source) {
  TomlSection file = TomlSection::parse(text, source);
  JointPlantConfig config = base_plant(file);
  for (const auto& [section, fields] : sections_of(config))
    read_section(file.section_or_empty(section), section, fields, config);
  file.refuse_unknown_keys();
  try {
    const JointPlant checked(config);
  } catch (const InputError& error) {
    throw InputError(source + ": " + error.what());
  }
  return config;
}

JointPlantConfig plant_named(const std::string& name_or_path) {
  for (const Setting setting : kSettings)
    if (name_or_path == name(setting)) return setting_plant(setting);
  if (!std::filesystem::exists(name_or_path))
    throw InputError("--plant", "plant", name_or_path,
                     "must be ideal, limited, realistic or a plant file that exists");
  return plant_from_toml(read_text_file(name_or_path), name_or_path);
}

}  // namespace strainwave
