// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/contenders.h"

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/printable.h"
#include "control/scheduled_controller.h"
#include "control/table/gain_table_json.h"

namespace strainwave {

namespace {

void require_period(const GainTable& table, const JointPlantConfig& plant) {
  if (std::abs(table.plant.period_s - plant.period_s) > 1e-9 * plant.period_s)
    throw InputError("gain table " + std::string(table.name.view()), "period_s",
                     number_text(table.plant.period_s),
                     "must be the plant's period, " + number_text(plant.period_s));
}

// A plant without a torque limit (the source's ideal setting) takes any torque, but a plan needs a number. In
// effect, 300 times the real actuator's peak is no limit.
constexpr double kNoTorqueLimit_Nm = 1e4;

double torque_limit_Nm(const JointPlantConfig& plant, const GainTable& table) {
  return std::isfinite(plant.motor.peak_torque_Nm)
             ? std::min(plant.motor.peak_torque_Nm, table.torque_limit_Nm)
             : kNoTorqueLimit_Nm;
}

}  // namespace

JointControllerConfig extended_config(const JointPlantConfig& plant, const GainTable& table,
                                      const MotionLimits& motion) {
  JointControllerConfig config;
  config.period_s = plant.period_s;
  config.encoder_resolution_rad = plant.encoder.resolution_rad();
  config.delay_periods = static_cast<int>(std::lround(plant.delay.periods));
  if (config.delay_periods > kMaxControlDelay)
    throw InputError("plant", "drive.delay_periods", number_text(plant.delay.periods),
                     "the daemon's controller allows 0 to " + std::to_string(kMaxControlDelay));
  config.torque_limit_Nm = table.torque_limit_Nm;
  config.motor = plant.motor;
  config.motor.peak_torque_Nm = config.torque_limit_Nm;
  config.motion = motion;
  if (plant.effects.transmission) {
    const Transmission& gear = *plant.effects.transmission;
    config.link = {plant.joint.inertia_kgm2, gear.link_inertia_kgm2, gear.spring, gear.damping_Nms_rad, {}};
    if (!table.box.rigid()) config.encoder_side = table.box.encoder_side;
    if (config.encoder_side == EncoderSide::kLink)
      config.encoder_resolution_rad = plant.link_encoder.resolution_rad();
  }
  config.gravity = plant.effects.gravity;
  return config;
}

JointPlantConfig with_declared_friction(JointPlantConfig plant, const GainTable& table,
                                        double temperature_C) {
  plant.joint.friction.asymptote = table.friction.blend(table.friction.weights(temperature_C));
  plant.joint.friction.amplitude = {};
  return plant;
}

Contender plain_contender(const std::string& name, const GainTable& table) {
  return {name, [table](const JointPlantConfig& plant) -> std::unique_ptr<LoopController> {
            require_period(table, plant);
            return std::make_unique<FeedbackLoopController>(table.primary, table.friction, table.plant,
                                                            plant.motor.peak_torque_Nm);
          }};
}

Contender extended_contender(const std::string& name, const GainTable& table, const MotionLimits& motion,
                             Mechanism without) {
  return {name, [table, motion, without](const JointPlantConfig& plant) -> std::unique_ptr<LoopController> {
            require_period(table, plant);
            GainTable limited = table;
            limited.torque_limit_Nm = torque_limit_Nm(plant, table);
            JointControllerConfig config = extended_config(plant, limited, motion);
            config.without = without;
            return std::make_unique<ExtendedLoopController>(config, limited);
          }};
}

Contender pid_contender() {
  return {"PID", [](const JointPlantConfig& plant) -> std::unique_ptr<LoopController> {
            return std::make_unique<PidLoopController>(PidGains{}, plant.period_s);
          }};
}

ExtendedLoopController::ExtendedLoopController(const JointControllerConfig& config,
                                               const GainTable& table) noexcept
    : config_(config), table_(table), controller_(config) {
  controller_.load(table_);
}

double ExtendedLoopController::torque_Nm(const LoopSample& sample) noexcept {
  if (!started_) controller_.start(sample.joint_position_rad);
  if (!started_ || controller_.plan().trajectory().target_rad() != sample.setpoint_position_rad)
    controller_.set_target(sample.setpoint_position_rad);
  started_ = true;
  const JointStep step = controller_.step(measurement_of(sample, sample.temperature_C));
  off_ = off_ || step.oscillates;
  return off_ ? 0.0 : step.output.torque_Nm;
}

void ExtendedLoopController::reset() noexcept {
  controller_ = JointController(config_);
  controller_.load(table_);
  off_ = false;
  started_ = false;
}

Chapter6Tables read_chapter6_tables(const std::filesystem::path& directory) {
  Chapter6Tables tables;
  for (const char* file : {"c1.json", "c2.json", "c3.json", "c4.json"})
    tables.source.push_back(read_gain_table(directory / file));
  tables.shipped = read_gain_table(directory / "rhs17-6006.json");
  return tables;
}

std::vector<Contender> chapter6_contenders(const Chapter6Tables& tables) {
  std::vector<Contender> contenders;
  for (std::size_t i = 0; i < tables.source.size(); ++i)
    contenders.push_back(plain_contender("C" + std::to_string(i + 1), tables.source[i]));
  contenders.push_back(pid_contender());
  contenders.push_back(extended_contender("C4+", tables.shipped));
  return contenders;
}

}  // namespace strainwave
