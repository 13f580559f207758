// SPDX-License-Identifier: BSD-3-Clause
// config/reference.toml shows the defaults: without its optional keys, the daemon reads the same configuration.
#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "tests/daemon/config/config_file_test.h"
#include "tests/support/example_keys.h"

namespace strainwave {
namespace {

using Values = std::map<std::string, double>;

Values daemon_values(const DaemonConfig& config) {
  const LoopConfig& loop = config.loop;
  const RecorderConfig& recorder = config.recorder;
  return {{"daemon.prefix", config.prefix == "SW"},
          {"daemon.lcm_url", config.lcm_url == "udpm://239.255.76.67:7667?ttl=0"},
          {"daemon.period_s", loop.period_s},
          {"daemon.real_time", loop.real_time == RealTimePolicy::kEnforce},
          {"daemon.priority", loop.priority},
          {"daemon.cpu", loop.cpu},
          {"daemon.stall_limit_s", loop.overruns.stall_s},
          {"daemon.missed_share_limit", loop.overruns.missed_share},
          {"daemon.state_rate_Hz", loop.state_rate_Hz},
          {"security.lease_s", config.security.lease_s},
          {"security.unsigned_orders", config.security.unsigned_allowed},
          {"recorder.seconds", recorder.seconds},
          {"recorder.post_trigger_s", recorder.post_trigger_s},
          {"recorder.max_files", recorder.max_files},
          {"recorder.max_total_MB", recorder.max_total_MB},
          {"recorder.min_interval_s", recorder.min_interval_s}};
}

Values loop_values(const JointLoopConfig& loop) {
  const TemperatureCheckConfig& temperature = loop.temperature;
  return {{"joint.damping_Nms_rad", loop.controller.link ? loop.controller.link->damping_Nms_rad : -1.0},
          {"joint.limits.position_margin_rad", loop.limits.position_margin_rad},
          {"joint.limits.deceleration_rad_s2", loop.controller.motion.deceleration_rad_s2},
          {"joint.limits.move_speed_share", loop.move_speed_share},
          {"joint.limits.overspeed_rad_s", loop.limits.overspeed_rad_s},
          {"joint.limits.temperature_limit_C", loop.limits.temperature_limit_C},
          {"joint.limits.derating_C", loop.limits.derating_C},
          {"joint.limits.on_overload", static_cast<double>(loop.overload_stop)},
          {"joint.temperature.min_C", temperature.min_C},
          {"joint.temperature.max_C", temperature.max_C},
          {"joint.temperature.max_rate_C_s", temperature.max_rate_C_s},
          {"joint.temperature.max_step_C", temperature.max_step_C},
          {"joint.temperature.max_age_s", temperature.max_age_s},
          {"joint.temperature.on_loss", temperature.loss_is_fault},
          {"joint.homing.to", static_cast<double>(loop.homing.target)},
          {"joint.homing.required", loop.homing.required},
          {"joint.homing.then_index", loop.homing.then_index},
          {"joint.homing.direction", loop.homing.direction},
          {"joint.homing.position_rad", loop.homing.home_position_rad},
          {"joint.homing.speed_rad_s", loop.homing.speed_rad_s},
          {"joint.homing.travel_rad", loop.homing.travel_rad},
          {"joint.homing.timeout_s", loop.homing.timeout_s},
          {"joint.supervision.start_timeout_s", loop.start_timeout_s},
          {"joint.supervision.stop_timeout_s", loop.stop_timeout_s},
          {"joint.supervision.standstill_rad_s", loop.standstill_rad_s},
          {"joint.supervision.overload_s", loop.overload_s},
          {"joint.supervision.blocked_s", loop.blocked_s},
          {"joint.supervision.rest_tolerance_rad", loop.rest_tolerance_rad},
          {"joint.supervision.missed_readings_limit", loop.missed_readings_limit},
          {"joint.control.initial_load_Nm", loop.initial_load_Nm},
          {"joint.control.stream_bridge_s", loop.controller.stream_bridge_s},
          {"joint.control.stream_delay_s", loop.controller.stream_delay_s},
          {"joint.control.torque_reserve", loop.controller.torque_reserve},
          {"joint.simulated.delay_periods", loop.controller.delay_periods},
          {"joint.simulated.encoder_side", static_cast<double>(loop.controller.encoder_side)}};
}

Values drive_values(const SimulatedActuatorConfig& drive) {
  return {{"joint.simulated.sensing", drive.plant.encoder.resolution_rad()},
          {"joint.simulated.inertia_kgm2", drive.plant.joint.inertia_kgm2},
          {"joint.simulated.friction", drive.plant.joint.stribeck.velocity_rad_s},
          {"joint.simulated.friction_scale", drive.plant.joint.friction.asymptote.coulomb_Nm},
          {"joint.simulated.substeps", drive.plant.substeps},
          {"joint.simulated.initial_position_rad", drive.plant.initial_position_rad},
          {"joint.simulated.incremental", drive.incremental},
          {"joint.simulated.enable_delay_s", drive.enable_delay_s},
          {"joint.simulated.watchdog_s", drive.watchdog_s},
          {"joint.simulated.temperature_period_s", drive.temperature_period_s},
          {"joint.simulated.temperature_noise_C", drive.temperature_noise_C},
          {"joint.simulated.seed", static_cast<double>(drive.seed)}};
}

Values values_of(const DaemonConfig& config) {
  Values values = daemon_values(config);
  const JointConfig& joint = config.joints.at(0);
  values.merge(loop_values(joint.loop));
  values.merge(drive_values(std::get<SimulatedDrive>(joint.drive).actuator));
  return values;
}

class ReferenceDefaults : public ConfigFileTest {
 protected:
  /// The reference without its optional keys, whose full names are then in `optional_`.
  std::string required_part() {
    const std::regex assignment(R"(^([A-Za-z0-9_]+) = [^#]*#?(.*))");
    const std::regex header(R"(^\[+([a-z_.]+)\]+)");
    std::istringstream lines(example("reference.toml"));
    std::string kept, section;
    for (std::string line; std::getline(lines, line);) {
      std::smatch match;
      if (std::regex_search(line, match, header)) section = match[1];
      const bool is_key = std::regex_search(line, match, assignment);
      if (is_key && !std::regex_search(match[2].str(), std::regex("^ (flexible: )?required")) &&
          section != "joint.simulated.fault")
        optional_.insert(section + "." + match[1].str());
      else
        kept += line + "\n";
    }
    return kept;
  }
  std::set<std::string> optional_;
};

// Values that are computed or read when the daemon starts, and are not in the configuration as read here.
const std::set<std::string> kAtStart = {"joint.limits.load_Nm", "joint.limits.load_notice_Nm",
                                        "joint.simulated.ambient_temperature_C",
                                        "joint.simulated.load_torque_Nm"};

TEST_F(ReferenceDefaults, AreWhatTheDaemonUsesWithoutTheKeys) {
  testing::write_authorized_keys(folder_);
  const std::string required = required_part();
  const Values shown = values_of(read(example("reference.toml")));
  const Values used = values_of(read(required));
  for (const auto& [key, value] : shown)
    EXPECT_NEAR(used.at(key), value, 0.01 * std::abs(value)) << key << ": the default, then the file's";
}

TEST_F(ReferenceDefaults, AreAllCompared) {
  testing::write_authorized_keys(folder_);
  required_part();
  std::set<std::string> compared = kAtStart;
  for (const auto& [key, value] : values_of(read(example("reference.toml")))) compared.insert(key);
  EXPECT_EQ(optional_, compared);
}

TEST_F(ReferenceDefaults, RefuseUnsignedOrders) {
  testing::write_authorized_keys(folder_);
  EXPECT_FALSE(read(example("reference.toml")).security.unsigned_allowed);
}

}  // namespace
}  // namespace strainwave
