#include "sim/joint/plant_file.h"

#include <toml++/toml.h>
#include <map>

#include "base/input_error.h"
#include "base/text_file.h"
#include "sim/studies/scenarios.h"

namespace strainwave {

namespace {

using Fields = std::map<std::string, double*>;

struct Whole {  // whole numbers are read as doubles and checked when they are put back
  double substeps;
  double delay_samples;
};

std::map<std::string, Fields> sections_of(JointPlantConfig& c, Whole& whole) {
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
           {{"peak_torque_Nm", &c.motor.peak_Nm},
            {"stall_torque_Nm", &c.motor.stall_Nm},
            {"torque_per_speed_Nms_rad", &c.motor.slope_Nms_rad},
            {"winding_loss_W_Nm2", &c.winding_loss_W_Nm2}}},
          {"encoder", {{"counts_per_joint_revolution", &c.encoder.counts_per_joint_revolution}}},
          {"thermal",
           {{"resistance_C_W", &c.thermal.resistance_C_W},
            {"time_constant_s", &c.thermal.time_constant_s},
            {"sensor_time_constant_s", &c.thermal.sensor_time_constant_s}}},
          {"simulation",
           {{"period_s", &c.period_s},
            {"substeps", &whole.substeps},
            {"delay_samples", &whole.delay_samples},
            {"initial_position_rad", &c.initial_position_rad}}}};
}

std::string known(const auto& map) {
  std::string keys;
  for (const auto& [key, value] : map) keys += (keys.empty() ? "" : ", ") + key;
  return keys;
}

std::string place(const std::string& source, const toml::node& node) {
  return source + ":" + std::to_string(node.source().begin.line);
}

JointPlantConfig base_plant(const toml::table& table, const std::string& source) {
  const toml::node* node = table.get("base");
  if (node == nullptr) return setting_plant(Setting::kRealistic);
  const auto text = node->value<std::string>();
  for (const Setting setting : kSettings)
    if (text && *text == name(setting)) return setting_plant(setting);
  throw InputError(place(source, *node), "base", text.value_or("(no text)"),
                   "must be ideal, limited or realistic");
}

void read_section(const toml::table& section, const std::string& section_name, const Fields& fields,
                  const std::string& source) {
  for (const auto& [key, node] : section) {
    const std::string name = section_name + "." + std::string(key.str());
    const auto field = fields.find(std::string(key.str()));
    if (field == fields.end())
      throw InputError(place(source, node) + ": unknown key " + name + "; allowed in [" + section_name +
                       "]: " + known(fields));
    const auto value = node.value<double>();
    if (!value) throw InputError(place(source, node) + ": " + name + " must be a number");
    *field->second = *value;
  }
}

int whole_number(double value, const std::string& source, const char* key) {
  if (!(value >= 0.0 && value <= 1e6 && value == static_cast<double>(static_cast<int>(value))))
    throw InputError(source, key, std::to_string(value), "must be a whole number >= 0");
  return static_cast<int>(value);
}

}  // namespace

JointPlantConfig plant_from_toml(std::string_view text, const std::string& source) {
  toml::table table;
  try {
    table = toml::parse(text, source);
  } catch (const toml::parse_error& error) {
    throw InputError(source + ":" + std::to_string(error.source().begin.line) + ": " +
                     std::string(error.description()));
  }
  JointPlantConfig config = base_plant(table, source);
  Whole whole{static_cast<double>(config.substeps), static_cast<double>(config.delay_samples)};
  const auto sections = sections_of(config, whole);
  for (const auto& [key, node] : table) {
    if (key.str() == "base") continue;
    const auto section = sections.find(std::string(key.str()));
    if (section == sections.end() || !node.is_table())
      throw InputError(place(source, node) + ": unknown key " + std::string(key.str()) +
                       "; allowed: base and the sections " + known(sections));
    read_section(*node.as_table(), section->first, section->second, source);
  }
  config.substeps = whole_number(whole.substeps, source, "simulation.substeps");
  config.delay_samples = whole_number(whole.delay_samples, source, "simulation.delay_samples");
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
