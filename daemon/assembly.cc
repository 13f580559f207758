// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/assembly.h"

#include <cmath>
#include <memory>

#include "drivers/thermometer_actuator.h"

namespace strainwave {

namespace {

using Buses = std::vector<std::unique_ptr<Fieldbus>>;

std::unique_ptr<Actuator> make_drive(const SimulatedDrive& drive, const Buses& /*buses*/) {
  return std::make_unique<FaultyActuator>(std::make_unique<SimulatedActuator>(drive.actuator), drive.faults);
}

std::unique_ptr<Actuator> make_drive(const GpioJointConfig& drive, const Buses& /*buses*/) {
  return make_gpio_actuator(drive);
}

std::unique_ptr<Actuator> make_drive(const DriveOnBus& drive, const Buses& buses) {
  return buses[drive.bus]->make_actuator(drive.slot);
}

std::unique_ptr<Actuator> make_drive(const JointConfig& joint, const Buses& buses) {
  auto drive = std::visit([&](const auto& config) { return make_drive(config, buses); }, joint.drive);
  if (!joint.thermometer) return drive;
  return std::make_unique<ThermometerActuator>(std::move(drive), *joint.thermometer);
}

std::unique_ptr<FlightRecorder> make_recorder(const RecorderConfig& recorder, double period_s) {
  if (!recorder.enabled()) return nullptr;
  const auto samples = [&](double duration_s) {
    return static_cast<std::size_t>(std::llround(duration_s / period_s));
  };
  return std::make_unique<FlightRecorder>(samples(recorder.seconds) + 2, samples(recorder.post_trigger_s));
}

}  // namespace

std::unique_ptr<Fieldbus> assemble_bus(const BusConfig& bus) {
  return open_can_bus(bus.config, bus.drives);
}

LoopParts assemble_loop(const DaemonConfig& config) {
  LoopParts parts;
  for (const BusConfig& bus : config.buses) parts.buses.push_back(assemble_bus(bus));
  for (const JointConfig& joint : config.joints)
    parts.joints.push_back(
        {joint.loop, make_drive(joint, parts.buses), make_recorder(config.recorder, config.loop.period_s)});
  return parts;
}

ExpectedJoint expected_joint(const JointConfig& joint) {
  const JointControllerConfig& controller = joint.loop.controller;
  return {joint.plant,
          controller.torque_limit_Nm,
          controller.link,
          controller.delay_periods,
          controller.encoder_side,
          !controller.drive_closes_loop()};
}

std::vector<JointAdmission> assemble_admission(const DaemonConfig& config) {
  std::vector<JointAdmission> joints;
  for (const JointConfig& joint : config.joints) {
    const JointControllerConfig& controller = joint.loop.controller;
    const JointLimits& limits = joint.loop.limits;
    joints.push_back({joint.name, expected_joint(joint), limits.position_min_rad, limits.position_max_rad,
                      controller.motion.velocity_rad_s, joint.takes_injected_faults,
                      PathLimits{{limits.position_min_rad, limits.position_max_rad},
                                 controller.motion,
                                 controller.torque_limit_Nm,
                                 joint.plant.inertia_kgm2,
                                 joint.plant.period_s}});
  }
  return joints;
}

}  // namespace strainwave
