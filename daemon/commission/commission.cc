// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/commission/commission.h"

#include <algorithm>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "control/joint/gear_catalogue.h"
#include "daemon/assembly.h"
#include "daemon/commission/commission_loop.h"
#include "daemon/drive_check.h"

namespace strainwave {

namespace {

namespace fs = std::filesystem;

// Largest way to either side of the start, and largest planned acceleration. Values of the study of this motion (tests/commission/study.cc).
constexpr double kMostWay_rad = 0.7;
constexpr double kMostAcceleration_rad_s2 = 3.0;

std::size_t find_joint(const DaemonConfig& config, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < config.joints.size(); ++i) {
    if (config.joints[i].name == name) return i;
    names += (i == 0 ? "" : ", ") + config.joints[i].name;
  }
  throw InputError("--commission " + name + ": a joint of the configuration is allowed: " + names);
}

const Gear& gear_of(const JointConfig& joint) {
  if (const Gear* const gear = find_gear(joint.plant.gear.view())) return *gear;
  throw InputError(joint.name + ": joint.gear: one of " + gear_names() +
                   " is allowed: commissioning uses the gear's lost motion and keeps its torque limit");
}

void require_commissionable(const JointConfig& joint) {
  const JointControllerConfig& controller = joint.loop.controller;
  if (!controller.link)
    throw InputError(joint.name +
                     ": joint.model = \"rigid\": only \"flexible\" with a gear is allowed: commissioning "
                     "measures the spring, too");
  if (controller.drive_closes_loop())
    throw InputError(
        joint.name +
        ": joint.can.drive_mode: only \"torque\" is allowed: commissioning orders torques, and a "
        "drive that closes its own loop takes none");
  if (controller.encoder_side == EncoderSide::kLink)
    throw InputError(
        joint.name +
        ": encoder_side = \"link\": only \"motor\" is allowed: commissioning measures the motor");
  if (const auto* const simulated = std::get_if<SimulatedDrive>(&joint.drive)) {
    const auto& gear = simulated->actuator.plant.effects.transmission;
    if (gear && gear->lost_motion.width_rad == 0.0)
      throw InputError(joint.name +
                       ": joint.simulated.spring.lost_motion_rad = 0: a number above 0 is allowed, such as "
                       "0.0003: commissioning needs a gear with lost motion");
  }
  if (joint.loop.homing.required)
    throw InputError(
        joint.name +
        ": joint.homing: a joint that must be homed has no position yet. For this run delete "
        "[joint.homing], set encoder = \"absolute\", and give limits around its present position");
  if (const Gear& gear = gear_of(joint); controller.torque_limit_Nm > gear.repeated_peak_torque_Nm)
    throw InputError(joint.name + ": joint.limits", "torque_limit_Nm",
                     number_text(controller.torque_limit_Nm),
                     "at most " + number_text(gear.repeated_peak_torque_Nm) +
                         " is allowed, the repeated peak torque of " + gear.name);
}

/// Preconditions for commissioning a real joint.
void require_watched(const DaemonConfig& config, const Interruption& interruption) {
  if (!interruption.has_terminal())
    throw InputError(
        "--commission: standard input is not a terminal: run it in one, where any key ends the motion");
  for (const JointConfig& joint : config.joints)
    if (joint.driver == "simulated")
      throw InputError(
          joint.name +
          ": joint.driver = \"simulated\" is not allowed beside a real joint: remove it for this run");
}

ExcitationConfig excitation_config(const JointConfig& joint, double period_s) {
  const JointControllerConfig& controller = joint.loop.controller;
  ExcitationConfig excitation;
  excitation.limits = {joint.loop.limits.position_min_rad, joint.loop.limits.position_max_rad,
                       controller.motion.velocity_rad_s,
                       std::min(kMostAcceleration_rad_s2, controller.motion.acceleration_rad_s2),
                       controller.torque_limit_Nm};
  excitation.limits.temperature_C = joint.loop.limits.temperature_limit_C;
  excitation.period_s = period_s;
  excitation.encoder_resolution_rad = controller.encoder_resolution_rad;
  excitation.gear_ratio = joint.plant.gear_ratio;
  excitation.motor_inertia_kgm2 = controller.link->motor_inertia_kgm2;
  return excitation;
}

void begin_at(double position_rad, ExcitationConfig& excitation) {
  excitation.start_rad = position_rad;
  ExcitationLimits& limits = excitation.limits;
  limits.position_min_rad = std::max(limits.position_min_rad, position_rad - kMostWay_rad);
  limits.position_max_rad = std::min(limits.position_max_rad, position_rad + kMostWay_rad);
}

std::string identity_of(const std::vector<std::string>& lines, bool simulated) {
  if (simulated) return "simulated drive, nothing to compare";
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
  return text.empty() ? "the drive has nothing that start-up could compare" : text;
}

}  // namespace

CommissioningConfig commissioning_config(const DaemonConfig& config, std::size_t index) {
  const JointConfig& joint = config.joints.at(index);
  require_commissionable(joint);
  const JointControllerConfig& controller = joint.loop.controller;
  const LinkModel& link = *controller.link;
  CommissioningConfig made;
  made.joint = joint.name;
  made.simulated = joint.driver == "simulated";
  made.direction_key =
      joint.driver == "gpio"
          ? "gpio.amplifier.reversed or gpio.encoder.reversed is wrong"
          : "torque acts against position; correct the sign of one of them in the drive, since " +
                joint.driver + ".direction turns both";
  made.excitation = excitation_config(joint, config.loop.period_s);
  made.told = {joint.plant.gear_ratio, link.spring, gear_of(joint).lost_motion_rad, link.motor_inertia_kgm2};
  ConfiguredNumbers& numbers = made.configured;
  if (!joint.motor_inertia_assumed) numbers.motor_inertia_kgm2 = link.motor_inertia_kgm2;
  if (!joint.load_inertia_assumed) numbers.load_inertia_kgm2 = link.link_inertia_kgm2;
  numbers.stiffness_1_Nm_rad = link.spring.stiffness_1_Nm_rad;
  if (link.damping_Nms_rad > 0.0) numbers.damping_Nms_rad = link.damping_Nms_rad;
  if (controller.gravity.torque_Nm > 0.0) numbers.gravity = controller.gravity;
  numbers.delay_periods = controller.delay_periods;
  numbers.delay_key = joint.driver + ".delay_periods";
  numbers.gear_ratio = joint.plant.gear_ratio;
  numbers.period_s = config.loop.period_s;
  return made;
}

ExitStatus commission_joint(const DaemonConfig& config, const fs::path& config_file, const std::string& joint,
                            const fs::path& directory, std::ostream& out) {
  const std::size_t index = find_joint(config, joint);
  CommissioningConfig what = commissioning_config(config, index);
  what.configuration = config_file.string();
  what.configuration_text = read_text_file(config_file);
  std::optional<CommissionRecord> before = read_commission_record(directory);
  Interruption interruption;
  if (!what.simulated) require_watched(config, interruption);
  const std::vector<InstanceLock> locks = lock_drives(config);
  CommissionLoop loop(config.loop, assemble_loop(config), index, what.simulated);
  if (!loop.real_time_refusal().empty())
    out << "warning: no real time: " << printable(loop.real_time_refusal()) << '\n';
  what.identity = identity_of(loop.take_messages(), what.simulated);
  begin_at(loop.first_position_rad(), what.excitation);
  Commissioning commissioning(what, std::move(before));
  out << joint << ": commissioning; any key ends it\n";
  const char* interrupted = nullptr;
  while (interrupted == nullptr) {
    const std::optional<std::string> announced = commissioning.begin();
    if (!announced) break;
    out << printable(*announced) << std::endl;
    interrupted = loop.run(commissioning, interruption);
    out << "  " << printable(commissioning.finish()) << std::endl;
    if (interrupted == nullptr) interrupted = interruption.wait(0);
    if (interrupted != nullptr) {
      commissioning.abort(interrupted);
      out << "ended: " << interrupted << '\n';
    }
    write_commission_record(directory, commissioning.record());
  }
  write_commission_record(directory, commissioning.record());
  out << "written: " << printable((directory / "commission.json").string()) << '\n';
  if (interrupted != nullptr) return ExitStatus::kInterrupted;
  return commissioning.record().problem.empty() ? ExitStatus::kDone : ExitStatus::kRefused;
}

}  // namespace strainwave
