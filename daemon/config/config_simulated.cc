// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_simulated.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/input_error.h"
#include "base/units.h"
#include "control/friction/friction_json.h"
#include "control/joint/friction_estimate.h"
#include "control/joint/gear_catalogue.h"
#include "control/joint/joint_catalogue.h"
#include "daemon/config/config_encoder.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "drivers/faulty_actuator.h"
#include "drivers/simulated_actuator.h"
#include "drivers/simulated_effects.h"

namespace strainwave {

namespace {

constexpr double kDefaultTemperatureNoise_C = 0.02;

TemperatureProfile read_ambient(TomlSection& section, const std::filesystem::path& folder) {
  const std::string text = section.text_or("ambient_temperature_C", "constant:25");
  try {
    return TemperatureProfile::parse(text, folder);
  } catch (const InputError& error) {
    section.fail("ambient_temperature_C", error.what());
  }
}

TimeProfile read_load(TomlSection& section, const std::filesystem::path& folder) {
  const std::string text = section.text_or("load_torque_Nm", "constant:0");
  try {
    return TimeProfile::parse(text, {"load_torque_Nm", -1e3, 1e3}, folder);
  } catch (const InputError& error) {
    section.fail("load_torque_Nm", error.what());
  }
}

// Reads what the controller assumes about the drive, as for a real drive. The defaults are the simulation's true values.
void read_what_is_told(TomlSection& section, const JointPlantConfig& plant, JointConfig& joint) {
  JointControllerConfig& controller = joint.loop.controller;
  read_encoder_side(section, controller, plant.feedback);
  const long delay_periods = std::lround(plant.delay.periods);
  if (delay_periods > kMaxControlDelay && !section.has("delay_periods"))
    section.fail("delay_periods", "give a number from 0 to " + std::to_string(kMaxControlDelay) +
                                      ", since joint.simulated.drive.delay_periods is larger");
  controller.delay_periods =
      static_cast<int>(section.integer_or("delay_periods", delay_periods, 0, kMaxControlDelay));
}

std::vector<std::string> injectable_faults() {
  std::vector<std::string> names;
  for (std::int32_t kind = 1; kind < kInjectedFaultCount; ++kind)
    names.emplace_back(to_text(static_cast<InjectedFault>(kind)));
  return names;
}

// [[joint.simulated.fault]]: faults that the drive has at set times.
std::vector<Injection> read_faults(TomlSection& section) {
  std::vector<Injection> faults;
  if (!section.has("fault")) return faults;
  for (TomlSection& fault : section.sections("fault")) {
    Injection injection;
    injection.kind = *injected_fault_of(fault.choice("kind", injectable_faults()));
    injection.at_s = fault.number_or("at_s", 0.0, {0.0, 1e6});
    injection.for_s = fault.number_or("for_s", 0.0, {0.0, 1e6});
    const AmountRange range = amount_range(injection.kind);
    if (range.min < range.max) injection.amount = fault.number("amount", {range.min, range.max});
    fault.refuse_unknown_keys();
    faults.push_back(injection);
  }
  return faults;
}

// The simulated joint has the configured inertias and spring by default; [joint.simulated] may override them.
void begin_with_model(const JointConfig& joint, JointPlantConfig& plant) {
  plant.joint.inertia_kgm2 = joint.plant.inertia_kgm2;
  const std::optional<LinkModel>& link = joint.loop.controller.link;
  if (!link) return;
  plant.joint.inertia_kgm2 = link->motor_inertia_kgm2;
  Transmission transmission;
  transmission.link_inertia_kgm2 = link->link_inertia_kgm2;
  transmission.spring = link->spring;
  transmission.damping_Nms_rad = link->damping_Nms_rad;
  plant.effects.transmission = transmission;
}

// Simulated motor and supply are the reference joint's. For another joint both are unknown, so its motor has no limits.
bool has_another_motor(const JointConfig& joint, const JointPlantConfig& plant) {
  const std::string_view gear = joint.plant.gear.view();
  return (!gear.empty() && gear != catalogue_joint().gear) ||
         joint.loop.controller.torque_limit_Nm > plant.motor.peak_torque_Nm;
}

// Reads the friction of a gear by its name, or from a file. The default is the joint's own gear, else the reference joint's.
FrictionLaw read_friction(TomlSection& section, const std::filesystem::path& folder,
                          const PlantIdentity& plant, const FrictionLaw& reference) {
  const std::string own = plant.gear.view().empty() ? catalogue_joint().gear : std::string(plant.gear.view());
  const std::string text = section.text_or("friction", own);
  if (const Gear* const gear = find_gear(text)) return estimate_friction(*gear, reference);
  if (!text.ends_with(".json"))
    section.fail("friction", "a gear of the catalogue is allowed, " + gear_names() +
                                 ", or a file.json of strainwave-design fit");
  try {
    return read_friction_law(folder / text, plant.gear_ratio);
  } catch (const InputError& error) {
    section.fail("friction", error.what());
  }
}

// Reads switches and index. An input without a key does not exist.
HomingInputs read_inputs(TomlSection& section, double gear_ratio, SimulatedInputsConfig& inputs) {
  constexpr Range kPosition{-1e3, 1e3};
  HomingInputs available;
  available.negative_limit = section.has("negative_limit_rad");
  if (available.negative_limit) inputs.negative_limit_rad = section.number("negative_limit_rad", kPosition);
  available.positive_limit = section.has("positive_limit_rad");
  if (available.positive_limit) inputs.positive_limit_rad = section.number("positive_limit_rad", kPosition);
  available.home = section.has("home_from_rad") || section.has("home_to_rad");
  if (available.home) {
    inputs.home_from_rad = section.number("home_from_rad", kPosition);
    inputs.home_to_rad = section.number("home_to_rad", {inputs.home_from_rad, kPosition.max});
  }
  available.index = section.has("index_rad");
  if (available.index) {
    inputs.index_rad = section.number("index_rad", kPosition);
    inputs.index_spacing_rad = kTurn_rad / gear_ratio;
  }
  return available;
}

// A joint that begins beyond its limits would fault before its first motion. Not for an incremental encoder, which may begin anywhere.
void refuse_beyond_limits(const TomlSection& section, double position_rad, const JointLimits& limits) {
  const auto allowed = [&](double angle_rad) {
    return angle_rad >= limits.position_min_rad && angle_rad <= limits.position_max_rad;
  };
  if (allowed(position_rad)) return;
  std::ostringstream text;
  text << "from " << number_text(limits.position_min_rad) << " to " << number_text(limits.position_max_rad)
       << " is allowed (joint.limits.position_min_rad and position_max_rad)";
  const double of_degrees_rad = position_rad * kTurn_rad / 360.0;
  if (position_rad != 0.0 && allowed(of_degrees_rad))
    text << std::setprecision(5) << "; if degrees are meant, write " << of_degrees_rad;
  section.fail("initial_position_rad", text.str());
}

}  // namespace

HomingInputs read_simulated_driver(TomlSection& section, double period_s, const std::filesystem::path& folder,
                                   JointConfig& joint) {
  const bool exact_sensing = section.choice_or("sensing", "encoder", {"encoder", "ideal"}) == "ideal";
  SimulatedActuatorConfig config = simulated_reference_joint(exact_sensing);
  config.plant.period_s = period_s;
  begin_with_model(joint, config.plant);
  if (has_another_motor(joint, config.plant)) config.plant.motor = {};
  // If only the simulation has a link, the configured inertia is not the motor's alone.
  const bool another = section.has("link") && !joint.loop.controller.link;
  config.plant.joint.inertia_kgm2 =
      another ? section.number("inertia_kgm2", {1e-6, 1e4})
              : section.number_or("inertia_kgm2", config.plant.joint.inertia_kgm2, {1e-6, 1e4});
  config.plant.initial_position_rad = section.number_or("initial_position_rad", 0.0, {-1e3, 1e3});
  read_simulated_effects(section, joint.plant.gear_ratio, config);
  const FrictionLaw friction =
      read_friction(section, folder, joint.plant, {config.plant.joint.friction, config.plant.joint.stribeck});
  config.plant.joint.friction = friction.over_temperature;
  config.plant.joint.stribeck = friction.stribeck;
  const double friction_scale = section.number_or("friction_scale", 1.0, {0.0, 10.0});
  for (FrictionParameters* part :
       {&config.plant.joint.friction.asymptote, &config.plant.joint.friction.amplitude}) {
    part->static_Nm *= friction_scale;
    part->coulomb_Nm *= friction_scale;
    part->viscous_Nms_rad *= friction_scale;
  }
  config.plant.substeps = static_cast<int>(section.integer_or("substeps", config.plant.substeps, 1, 1000));
  try {
    (void)JointPlant(config.plant);
  } catch (const InputError& error) {
    section.fail("substeps", error.what());
  }
  config.incremental = section.boolean_or("incremental", config.incremental);
  if (!config.incremental)
    refuse_beyond_limits(section, config.plant.initial_position_rad, joint.loop.limits);
  const HomingInputs available = read_inputs(section, joint.plant.gear_ratio, config.inputs);
  config.ambient = read_ambient(section, folder);
  config.load_torque_Nm = read_load(section, folder);
  config.enable_delay_s = section.number_or("enable_delay_s", config.enable_delay_s, {0.0, 10.0});
  config.watchdog_s = section.number_or("watchdog_s", config.watchdog_s, {0.0, 10.0});
  config.temperature_period_s =
      section.number_or("temperature_period_s", config.temperature_period_s, {0.0, 60.0});
  config.temperature_noise_C =
      section.number_or("temperature_noise_C", kDefaultTemperatureNoise_C, {0.0, 10.0});
  config.seed = static_cast<std::uint64_t>(section.integer_or("seed", 1, 0, INT64_MAX));

  JointControllerConfig& controller = joint.loop.controller;
  controller.encoder_resolution_rad = config.plant.feedback == EncoderSide::kLink
                                          ? config.plant.link_encoder.resolution_rad()
                                          : config.plant.encoder.resolution_rad();
  read_what_is_told(section, config.plant, joint);
  controller.motor = config.plant.motor;
  joint.drive = SimulatedDrive{config, {period_s, read_faults(section), &busy_wait, config.seed + 1}};
  joint.takes_injected_faults = true;
  return available;
}

}  // namespace strainwave
