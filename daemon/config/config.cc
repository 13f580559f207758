#include "daemon/config/config.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "base/input_error.h"
#include "base/protected_file.h"
#include "base/toml_section.h"
#include "daemon/config/config_can.h"
#include "daemon/config/config_gpio.h"
#include "daemon/config/config_homing.h"
#include "daemon/config/config_link.h"
#include "daemon/config/config_simulated.h"
#include "daemon/config/config_thermometer.h"
#include "lcmtypes/channels.h"

namespace strainwave {

namespace {

constexpr Range kAnyAngle{-1e4, 1e4};
constexpr Range kPositive{1e-9, 1e9};
constexpr double kOrderLifetime_s = 1.0;
constexpr double kMaxRecorder_MB = 1024.0;
constexpr const char* kDefaultLcmUrl = "udpm://239.255.76.67:7667?ttl=0";

LoopConfig read_loop(TomlSection& section) {
  LoopConfig loop;
  loop.period_s = section.number_or("period_s", loop.period_s, {1e-4, 0.1});
  loop.real_time = section.choice_or("real_time", "enforce", {"enforce", "ignore"}) == "ignore"
                       ? RealTimePolicy::kIgnore
                       : RealTimePolicy::kEnforce;
  loop.priority = static_cast<int>(section.integer_or("priority", loop.priority, 1, 98));
  loop.cpu = static_cast<int>(section.integer_or("cpu", loop.cpu, -1, 1023));
  OverrunLimits& overruns = loop.overruns;
  overruns.in_a_row = static_cast<int>(section.integer_or("overrun_limit", overruns.in_a_row, 1, 1000000));
  overruns.stall_s = section.number_or("stall_limit_s", std::max(overruns.stall_s, 2.0 * loop.period_s),
                                       {2.0 * loop.period_s, 1e6});
  overruns.missed_share = section.number_or("missed_share_limit", overruns.missed_share, {0.0, 1.0});
  loop.state_rate_Hz = section.number_or("state_rate_Hz", loop.state_rate_Hz, {0.1, 1.0 / loop.period_s});
  return loop;
}

RecorderConfig read_recorder(TomlSection section, const std::filesystem::path& folder) {
  RecorderConfig recorder;
  recorder.seconds = section.number_or("seconds", recorder.seconds, {0.01, 600.0});
  recorder.post_trigger_s =
      section.number_or("post_trigger_s", std::min(recorder.post_trigger_s, 0.1 * recorder.seconds),
                        {0.0, 0.9 * recorder.seconds});
  // systemd's StateDirectory=, the first if there are several.
  const char* state = std::getenv("STATE_DIRECTORY");  // NOLINT(concurrency-mt-unsafe): before any thread
  if (section.has("directory")) {
    recorder.directory = folder / section.text("directory");
  } else if (state != nullptr && *state != '\0') {
    recorder.directory =
        std::filesystem::path(std::string_view(state).substr(0, std::string_view(state).find(':'))) /
        "flight-records";
  }
  recorder.max_files = static_cast<int>(section.integer_or("max_files", recorder.max_files, 1, 100000));
  recorder.max_total_MB = section.number_or("max_total_MB", recorder.max_total_MB, {0.001, 1e6});
  recorder.min_interval_s = section.number_or("min_interval_s", recorder.min_interval_s, {0.0, 1e6});
  section.refuse_unknown_keys();
  return recorder;
}

std::string read_name(TomlSection& section, std::string_view key, std::string fallback) {
  std::string name = fallback.empty() ? section.text(key) : section.text_or(key, std::move(fallback));
  if (!is_valid_name(name)) section.fail(key, "1 to 24 of the characters A-Z a-z 0-9 _ - are allowed");
  return name;
}

void read_limits(TomlSection section, JointLoopConfig& loop) {
  JointLimits& limits = loop.limits;
  limits.position_min_rad = section.number("position_min_rad", kAnyAngle);
  limits.position_max_rad = section.number("position_max_rad", kAnyAngle);
  if (limits.position_min_rad >= limits.position_max_rad)
    section.fail("position_max_rad", "a position above position_min_rad is allowed");
  limits.position_margin_rad = section.number_or("position_margin_rad", 0.05, {0.0, 10.0});
  loop.controller.motion.velocity_rad_s = section.number("speed_limit_rad_s", {1e-4, 1e3});
  loop.controller.motion.acceleration_rad_s2 = section.number("acceleration_rad_s2", {1e-3, 1e6});
  loop.controller.motion.deceleration_rad_s2 =
      section.number_or("deceleration_rad_s2", loop.controller.motion.acceleration_rad_s2, {1e-3, 1e6});
  const double speed_rad_s = loop.controller.motion.velocity_rad_s;
  limits.overspeed_rad_s = section.number_or("overspeed_rad_s", 1.25 * speed_rad_s + 0.1, {speed_rad_s, 1e3});
  limits.following_error_rad = section.number("following_error_rad", {1e-6, 100.0});
  loop.controller.torque_limit_Nm = section.number("torque_limit_Nm", kPositive);
  limits.temperature_limit_C = section.number_or("temperature_limit_C", 80.0, {-50.0, 200.0});
  limits.load_Nm = section.number_or("load_Nm", loop.controller.torque_limit_Nm, kPositive);
  section.refuse_unknown_keys();
}

void read_temperature_check(TomlSection section, JointLoopConfig& loop) {
  TemperatureCheckConfig& check = loop.temperature;
  loop.temperature_update_period_s =
      section.number_or("update_period_s", loop.temperature_update_period_s, {1e-4, 60.0});
  check.min_C = section.number_or("min_C", check.min_C, {-273.0, 300.0});
  check.max_C = section.number_or("max_C", check.max_C, {check.min_C, 300.0});
  check.max_rate_C_s = section.number_or("max_rate_C_s", check.max_rate_C_s, {1e-3, 1e3});
  check.max_step_C = section.number_or("max_step_C", check.max_step_C, {1e-3, 300.0});
  check.max_age_s = section.number_or("max_age_s", check.max_age_s, {1e-3, 3600.0});
  check.max_constant_s = section.number_or("max_constant_s", check.max_constant_s, {0.0, 86400.0});
  check.recovery_s = section.number_or("recovery_s", check.recovery_s, {0.0, 3600.0});
  check.loss_is_fault = section.choice_or("on_loss", "fallback", {"fallback", "fault"}) == "fault";
  // What is above max_C is not believed: the limit must be reached before.
  if (loop.limits.temperature_limit_C >= check.max_C)
    section.fail("max_C", "a temperature above joint.limits.temperature_limit_C = " +
                              std::to_string(loop.limits.temperature_limit_C) +
                              " is allowed: a joint at its limit must be believed");
  section.refuse_unknown_keys();
}

void read_timeouts(TomlSection section, JointLoopConfig& loop) {
  loop.start_timeout_s = section.number_or("start_timeout_s", loop.start_timeout_s, {0.01, 60.0});
  loop.stop_timeout_s = section.number_or("stop_timeout_s", loop.stop_timeout_s, {0.01, 60.0});
  loop.standstill_rad_s = section.number_or("standstill_rad_s", loop.standstill_rad_s, {1e-6, 1.0});
  loop.blocked_s = section.number_or("blocked_s", loop.blocked_s, {0.01, 60.0});
  loop.missed_readings_limit =
      static_cast<int>(section.integer_or("missed_readings_limit", loop.missed_readings_limit, 0, 1000));
  section.refuse_unknown_keys();
}

void read_features(TomlSection section, const PlantIdentity& plant, JointLoopConfig& loop) {
  JointControllerConfig& controller = loop.controller;
  controller.use_shaping = section.boolean_or("shaping", controller.use_shaping);
  controller.use_rest = section.boolean_or("rest", controller.use_rest);
  controller.rigid = section.boolean_or("rigid", controller.rigid);
  controller.use_observer = section.boolean_or("observer", controller.rigid);
  if (controller.use_observer && !controller.rigid)
    section.fail("observer", "true is allowed only with rigid = true: its model is one inertia");
  const bool can_land = controller.rigid && controller.use_observer && controller.use_rest;
  controller.use_landing = section.boolean_or("landing", can_land);
  if (controller.use_landing && !can_land)
    section.fail("landing", "true is allowed only with rigid = true, observer = true and rest = true");
  controller.encoder_deviation_counts =
      section.number_or("encoder_deviation_counts", controller.encoder_deviation_counts, {1e-3, 10.0});
  loop.initial_load_Nm = section.number_or("initial_load_Nm", loop.initial_load_Nm, {-1e6, 1e6});
  controller.torque_reserve = section.number_or("torque_reserve", controller.torque_reserve, {0.0, 0.9});
  read_link(section, plant, controller);
  section.refuse_unknown_keys();
}

JointConfig read_joint(TomlSection& section, double period_s, const std::filesystem::path& folder,
                       CanConfig& can) {
  JointConfig joint;
  joint.name = read_name(section, "name", "");
  joint.plant.joint_model = FixedString<32>(section.text("joint_model"));
  joint.plant.inertia_kgm2 = section.number("inertia_kgm2", kPositive);
  joint.plant.gear_ratio = section.number("gear_ratio", {1e-3, 1e5});
  joint.plant.period_s = period_s;
  joint.loop.controller.period_s = period_s;
  if (section.has("table")) joint.table = folder / section.text("table");
  read_limits(section.section("limits"), joint.loop);
  read_temperature_check(section.section_or_empty("temperature"), joint.loop);
  if (section.has("group")) joint.group = read_name(section, "group", "");
  joint.loop.fault_stops_group = section.choice_or("on_fault", "joint", {"joint", "group"}) == "group";
  if (joint.loop.fault_stops_group && joint.group.empty())
    section.fail("on_fault", "\"group\" needs joint.group as well");
  read_timeouts(section.section_or_empty("supervision"), joint.loop);
  read_features(section.section_or_empty("control"), joint.plant, joint.loop);
  joint.driver = section.choice("driver", {"simulated", "can", "gpio"});
  if (section.has("thermometer")) joint.thermometer = read_thermometer(section.section("thermometer"));
  if (joint.thermometer && joint.driver == "simulated")
    section.fail("thermometer",
                 "a sensor of a real drive is allowed: the simulated one has its own temperature");
  TomlSection driver = section.section_or_empty(joint.driver);
  if (joint.thermometer && driver.has("temperature"))
    section.fail("thermometer",
                 "one temperature is allowed: this sensor, or the drive's own in joint.can.temperature");
  HomingInputs inputs;
  if (joint.driver == "can")
    inputs = can.read_joint(driver, joint);
  else if (joint.driver == "gpio")
    inputs = read_gpio_driver(driver, section.full_name("gpio"), period_s, joint);
  else
    inputs = read_simulated_driver(driver, period_s, joint);
  driver.refuse_unknown_keys();
  read_homing(section.section_or_empty("homing"), inputs, joint);
  section.refuse_unknown_keys();
  return joint;
}

// Names of groups become numbers, which the loop compares.
void number_groups(std::vector<JointConfig>& joints) {
  std::vector<std::string> groups;
  for (JointConfig& joint : joints) {
    if (joint.group.empty()) continue;
    const auto found = std::find(groups.begin(), groups.end(), joint.group);
    joint.loop.group = static_cast<int>(found - groups.begin());
    if (found == groups.end()) groups.push_back(joint.group);
  }
}

GatewayUser read_gateway_user(TomlSection& section) {
  const bool chosen = section.has("gateway_user");
  const std::string name = section.text_or("gateway_user", "");
  try {
    return chosen ? gateway_user_named(name) : default_gateway_user();
  } catch (const InputError& error) {
    section.fail("gateway_user", error.what());
  }
}

SecurityPolicy read_security(TomlSection section, const LoopConfig& loop,
                             const std::vector<JointConfig>& joints, const std::filesystem::path& folder) {
  SecurityPolicy security;
  security.lease_s = section.number_or("lease_s", security.lease_s, {0.1, 3600.0});
  // An order quotes what a state has told: it lives for a second beyond the time between two states.
  security.order_lifetime_cycles =
      std::llround((kOrderLifetime_s + 1.0 / loop.state_rate_Hz) / loop.period_s);
  security.unsigned_allowed = section.choice_or("unsigned_orders", "refuse", {"refuse", "allow"}) == "allow";
  const bool simulated = std::all_of(joints.begin(), joints.end(),
                                     [](const JointConfig& joint) { return joint.driver == "simulated"; });
  if (security.unsigned_allowed && !simulated)
    section.fail("unsigned_orders",
                 "\"refuse\" is allowed: only simulated joints may move for anybody who asks");
  if (section.has("authorized_keys"))
    security.keys = read_authorized_keys(credential_or_file(folder / section.text("authorized_keys")));
  else if (!security.unsigned_allowed)
    section.fail("authorized_keys",
                 "give the file with the public keys that may give orders (strainwavectl keygen makes "
                 "one), or, with simulated joints alone, security.unsigned_orders = \"allow\"");
  section.refuse_unknown_keys();
  return security;
}

}  // namespace

DaemonConfig read_config(const std::filesystem::path& path) {
  require_protected(path, Writers::kGroup);
  TomlSection root = TomlSection::read(path);
  DaemonConfig config;
  TomlSection daemon = root.section_or_empty("daemon");
  config.loop = read_loop(daemon);
  config.prefix = read_name(daemon, "prefix", "SW");
  config.lcm_url = daemon.text_or("lcm_url", kDefaultLcmUrl);
  config.gateway_user = read_gateway_user(daemon);
  daemon.refuse_unknown_keys();

  CanConfig can(root, config.loop.period_s);
  std::vector<TomlSection> joints = root.sections("joint");
  if (joints.size() > kMaxJoints)
    root.fail("joint", "1 to " + std::to_string(kMaxJoints) + " joints are allowed");
  std::set<std::string> names;
  for (TomlSection& section : joints) {
    config.joints.push_back(read_joint(section, config.loop.period_s, path.parent_path(), can));
    if (!names.insert(config.joints.back().name).second)
      section.fail("name", "each joint needs a name of its own");
  }
  config.buses = can.buses();
  number_groups(config.joints);
  config.recorder = read_recorder(root.section_or_empty("recorder"), path.parent_path());
  const double recorder_MB = static_cast<double>(config.joints.size() * sizeof(FlightSample)) *
                             config.recorder.seconds / config.loop.period_s / 1e6;
  if (recorder_MB > kMaxRecorder_MB)
    root.fail("recorder", "fewer seconds are allowed: " + std::to_string(std::lround(recorder_MB)) +
                              " MB of memory would be locked for " + std::to_string(config.joints.size()) +
                              " joints, at most " + std::to_string(std::lround(kMaxRecorder_MB)));
  config.security =
      read_security(root.section_or_empty("security"), config.loop, config.joints, path.parent_path());
  root.refuse_unknown_keys();
  return config;
}

}  // namespace strainwave
