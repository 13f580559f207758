// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

#include "base/input_error.h"
#include "base/protected_file.h"
#include "base/toml_section.h"
#include "daemon/config/config_can.h"
#include "daemon/config/config_doubts.h"
#include "daemon/config/config_joint.h"
#include "lcmtypes/multicast_check.h"

namespace strainwave {

namespace {

constexpr double kOrderLifetime_s = 1.0;
constexpr double kMaxRecorder_MB = 1024.0;
// A loop that is late in every cycle misses at least as many periods as it keeps.
constexpr double kShareOfLateLoop = 0.5;

/// Highest processor number of this machine.
std::int64_t last_processor() {
  return std::max(1L, ::sysconf(_SC_NPROCESSORS_CONF)) - 1;
}

LoopConfig read_loop(TomlSection& section) {
  LoopConfig loop;
  loop.period_s = section.number_or("period_s", loop.period_s, {1e-4, 0.1});
  loop.real_time = section.choice_or("real_time", "enforce", {"enforce", "ignore"}) == "ignore"
                       ? RealTimePolicy::kIgnore
                       : RealTimePolicy::kEnforce;
  loop.priority = static_cast<int>(section.integer_or("priority", loop.priority, 1, 98));
  loop.cpu = static_cast<int>(section.integer_or("cpu", loop.cpu, -1, last_processor()));
  OverrunLimits& overruns = loop.overruns;
  const double usual_stall_s = std::max(overruns.stall_s, 2.0 * loop.period_s);
  overruns.stall_s = section.number_or("stall_limit_s", usual_stall_s, {2.0 * loop.period_s, 1e6});
  overruns.missed_share = section.number_or("missed_share_limit", overruns.missed_share, {0.0, 1.0});
  if (overruns.missed_share >= kShareOfLateLoop && overruns.missed_share < 1.0)
    section.fail(
        "missed_share_limit",
        "below 0.5, or 1 for no supervision, is allowed: a loop that is late in every cycle misses half "
        "of its periods");
  loop.state_rate_Hz = section.number_or("state_rate_Hz", loop.state_rate_Hz, {0.1, 1.0 / loop.period_s});
  doubt_loop(section, loop, usual_stall_s);
  return loop;
}

// Returns the first folder of systemd's StateDirectory=; empty: there is none.
std::filesystem::path service_state_directory() {
  const char* state = std::getenv("STATE_DIRECTORY");  // NOLINT(concurrency-mt-unsafe): before any thread
  if (state == nullptr) return {};
  return std::string_view(state).substr(0, std::string_view(state).find(':'));
}

std::filesystem::path read_state_directory(TomlSection& section, const std::filesystem::path& folder) {
  if (!section.has("state_directory")) return service_state_directory();
  std::filesystem::path directory = folder / section.text("state_directory");
  doubt_folder(section, "state_directory", directory);
  return directory;
}

RecorderConfig read_recorder(TomlSection section, const std::filesystem::path& folder) {
  RecorderConfig recorder;
  recorder.seconds = section.number_or("seconds", recorder.seconds, {0.01, 600.0});
  recorder.post_trigger_s =
      section.number_or("post_trigger_s", std::min(recorder.post_trigger_s, 0.1 * recorder.seconds),
                        {0.0, 0.9 * recorder.seconds});
  if (section.has("directory")) {
    recorder.directory = folder / section.text("directory");
    doubt_folder(section, "directory", recorder.directory);
  } else if (const std::filesystem::path state = service_state_directory(); !state.empty()) {
    recorder.directory = state / "flight-records";
  }
  recorder.max_files = static_cast<int>(section.integer_or("max_files", recorder.max_files, 1, 100000));
  recorder.max_total_MB = section.number_or("max_total_MB", recorder.max_total_MB, {0.001, 1e6});
  recorder.min_interval_s = section.number_or("min_interval_s", recorder.min_interval_s, {0.0, 1e6});
  section.refuse_unknown_keys();
  return recorder;
}

// Replaces the names of groups by numbers, which the loop compares.
void number_groups(std::vector<JointConfig>& joints) {
  std::vector<std::string> groups;
  for (JointConfig& joint : joints) {
    if (joint.group.empty()) continue;
    const auto found = std::find(groups.begin(), groups.end(), joint.group);
    joint.loop.group = static_cast<int>(found - groups.begin());
    if (found == groups.end()) groups.push_back(joint.group);
  }
}

std::string read_lcm_url(TomlSection& section) {
  constexpr std::size_t kLongest = 255;
  std::string url = section.text_or("lcm_url", kUsualLcmUrl);
  if (const auto defect = find_udpm_defect(url)) section.fail("lcm_url", *defect);
  if (url.size() > kLongest) section.fail("lcm_url", "at most 255 characters are allowed");
  return url;
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
  // An order quotes the challenge of a state. It stays valid for a second more than the interval between two states.
  security.order_lifetime_cycles =
      std::llround((kOrderLifetime_s + 1.0 / loop.state_rate_Hz) / loop.period_s);
  security.unsigned_allowed = section.choice_or("unsigned_orders", "refuse", {"refuse", "allow"}) == "allow";
  const bool simulated = std::all_of(joints.begin(), joints.end(),
                                     [](const JointConfig& joint) { return joint.driver == "simulated"; });
  if (security.unsigned_allowed && !simulated)
    section.fail("unsigned_orders", "only \"refuse\" is allowed with a real joint");
  const std::string keys = section.text_or("authorized_keys", "");
  section.refuse_unknown_keys();  // first: a missing key may be there under a wrong name
  if (section.has("authorized_keys"))
    security.keys = read_authorized_keys(credential_or_file(folder / keys));
  else if (!security.unsigned_allowed)
    section.fail("authorized_keys",
                 "give the file of public keys that may give orders (strainwavectl keygen makes keys); with "
                 "simulated joints alone, security.unsigned_orders = \"allow\" is possible instead");
  return security;
}

}  // namespace

Writers writers_allowed(const JointConfig& joint) {
  return joint.driver == "simulated" ? Writers::kGroup : Writers::kNobody;
}

DaemonConfig read_config(const std::filesystem::path& path, ConfigUse use) {
  require_protected(path, Writers::kGroup);
  TomlSection root = TomlSection::read(path);
  root.collect_errors();
  DaemonConfig config;
  TomlSection daemon = root.section_or_empty("daemon");
  config.loop = read_loop(daemon);
  config.prefix = read_name(daemon, "prefix", "SW");
  config.lcm_url = read_lcm_url(daemon);
  config.gateway_user = read_gateway_user(daemon);
  config.state_directory = read_state_directory(daemon, path.parent_path());
  daemon.refuse_unknown_keys();

  CanConfig can(root, config.loop.period_s, config.loop.overruns.stall_s);
  std::vector<TomlSection> joints = root.sections("joint");
  if (joints.size() > kMaxJoints)
    root.fail("joint", "1 to " + std::to_string(kMaxJoints) + " joints are allowed");
  std::set<std::string> names;
  for (TomlSection& section : joints) {
    try {
      config.joints.push_back(read_joint(section, config.loop.period_s, path.parent_path(), can, use));
      if (!names.insert(config.joints.back().name).second)
        section.fail("name", "each joint needs a name of its own");
    } catch (const InputError& error) {
      root.note_error(error.what());
    }
  }
  root.throw_errors();
  config.buses = can.buses();
  number_groups(config.joints);
  config.recorder = read_recorder(root.section_or_empty("recorder"), path.parent_path());
  const double recorder_MB = static_cast<double>(config.joints.size() * sizeof(FlightSample)) *
                             config.recorder.seconds / config.loop.period_s / 1e6;
  if (recorder_MB > kMaxRecorder_MB)
    root.fail("recorder", "the daemon would lock " + std::to_string(std::lround(recorder_MB)) +
                              " MB of memory for " + std::to_string(config.joints.size()) +
                              " joints, at most " + std::to_string(std::lround(kMaxRecorder_MB)) +
                              " MB are allowed: lower recorder.seconds");
  const TomlSection security = root.section_or_empty("security");
  root.refuse_unknown_keys();
  root.throw_errors();
  if (use == ConfigUse::kRun)
    config.security = read_security(security, config.loop, config.joints, path.parent_path());
  root.throw_errors();
  // Every user with write access to this file controls its joints.
  for (const JointConfig& joint : config.joints) require_protected(path, writers_allowed(joint));
  config.warnings = root.warnings();
  if (const auto exposure = find_exposure(path, Writers::kNobody))
    config.warnings.push_back(*exposure + "; a real joint needs this");
  return config;
}

}  // namespace strainwave
