// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/odrive/odrive_setup.h"

#include <array>
#include <cstdio>
#include <functional>

#include "base/durations.h"
#include "base/input_error.h"

namespace strainwave::odrive {

namespace {

constexpr std::int64_t kAnswerTimeout_ns = 500'000'000;
constexpr std::int64_t kListenFor_ns = 500'000'000;
/// Share of the expected messages that must arrive; the clocks of drive and host differ.
constexpr double kEnough = 0.9;

std::string where(const DriveConfig& config) {
  return config.name + ": ODrive node " + std::to_string(config.node_id);
}

/// Passes every data frame to `take` until it returns true or the time is over.
bool listen(CanPort& port, const DriveConfig& config, std::int64_t duration_ns,
            const std::function<bool(const CanFrame&)>& take) {
  std::array<ReceivedFrame, 16> frames;
  const std::int64_t end_ns = port.now_ns() + duration_ns;
  for (;;) {
    const ReceiveResult result = port.receive(frames);
    if (result.link != CanLink::kUp) throw InputError(where(config) + ": the CAN interface is down or gone");
    for (std::size_t i = 0; i < result.count; ++i)
      if (frames[i].kind == ReceivedFrame::Kind::kData && take(frames[i].frame)) return true;
    const std::int64_t left_ns = end_ns - port.now_ns();
    if (left_ns <= 0) return false;
    if (result.count == 0) (void)port.wait(left_ns);
  }
}

void send(CanPort& port, const DriveConfig& config, const CanFrame& frame) {
  if (port.send(frame) != SendResult::kSent)
    throw InputError(where(config) + ": the CAN interface does not accept a frame");
}

/// Sends `request` and returns the first frame with `answer`'s identifier that `decode` accepts.
template <typename Value>
std::optional<Value> ask(CanPort& port, const DriveConfig& config, const CanFrame& request, Command answer,
                         const std::function<std::optional<Value>(const CanFrame&)>& decode) {
  send(port, config, request);
  std::optional<Value> value;
  listen(port, config, kAnswerTimeout_ns, [&](const CanFrame& frame) {
    if (frame.id == can_id(answer, config.node_id)) value = decode(frame);
    return value.has_value();
  });
  return value;
}

std::string version_text(const Version& version) {
  return std::to_string(version.firmware_major) + "." + std::to_string(version.firmware_minor) + "." +
         std::to_string(version.firmware_revision);
}

std::string check_version(CanPort& port, const DriveConfig& config) {
  const auto version = ask<Version>(port, config, request_frame(config.node_id, Command::kVersion),
                                    Command::kVersion, decode_version);
  if (!version)
    throw InputError(where(config) +
                     " does not give its version: check node_id, bit rate and wiring; firmware 0.5 has no "
                     "such message, and is not supported");
  if (version->firmware_major != 0 || version->firmware_minor != 6)
    throw InputError(where(config), "firmware", version_text(*version),
                     "must be 0.6: other versions number their messages differently");
  return where(config) + ": firmware " + version_text(*version);
}

std::string check_watchdog(CanPort& port, const DriveConfig& config) {
  if (!config.watchdog)
    return where(config) +
           ": its watchdog was NOT verified ([joint.can.watchdog] is not set): if it is off, the drive goes "
           "on "
           "with its last torque when this daemon ends";
  const auto parameter = [&]<typename Value>(std::uint16_t endpoint, auto decode, Value /*type*/) {
    const auto value =
        ask<Value>(port, config, read_parameter_frame(config.node_id, endpoint), Command::kParameter,
                   [&](const CanFrame& frame) { return decode(frame, endpoint); });
    if (!value)
      throw InputError(where(config) + " does not give its parameter " + std::to_string(endpoint) +
                       ": take enabled_endpoint and timeout_endpoint of [joint.can.watchdog] from the "
                       "flat_endpoints.json of its firmware");
    return *value;
  };
  if (!parameter(config.watchdog->enabled, decode_parameter_bool, bool{}))
    throw InputError(where(config), "axis0.config.enable_watchdog", "False",
                     "must be True: it alone stops the drive when this daemon ends");
  const double timeout_s = parameter(config.watchdog->timeout, decode_parameter_float, double{});
  if (!(timeout_s > 2.0 * config.period_s && timeout_s <= config.max_watchdog_s))
    throw InputError(where(config), "axis0.config.watchdog_timeout", std::to_string(timeout_s),
                     "must be above two periods and at most " + std::to_string(config.max_watchdog_s));
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), ": its watchdog stops it after %.3f s", timeout_s);
  return where(config) + text.data();
}

}  // namespace

std::vector<std::string> check_axis(CanPort& port, const DriveConfig& config) {
  return {check_version(port, config), check_watchdog(port, config)};
}

void verify_axis(CanPort& port, const DriveConfig& config) {
  int estimates = 0;
  int torques = 0;
  bool heartbeat = false;
  bool temperature = config.temperature == TemperatureSource::kNone;
  listen(port, config, kListenFor_ns, [&](const CanFrame& frame) {
    const auto is = [&](Command command) { return frame.id == can_id(command, config.node_id); };
    if (is(Command::kEstimates) && decode_estimates(frame)) ++estimates;
    if (is(Command::kTorques) && decode_torque_Nm(frame)) ++torques;
    heartbeat = heartbeat || (is(Command::kHeartbeat) && decode_heartbeat(frame));
    if (is(Command::kTemperatures))
      if (const auto temperatures = decode_temperatures(frame))
        temperature = temperature || joint_temperature_C(config.temperature, *temperatures);
    return false;
  });
  const std::string settings = where(config) + ": axis0.config.can.";
  if (!heartbeat)
    throw InputError(settings + "heartbeat_msg_rate_ms: no heartbeat within 0.5 s; set it to " +
                     std::to_string(static_cast<int>(config.heartbeat_period_s * 1e3)));
  const auto require_each_period = [&](int count, const char* setting, const char* what) {
    if (count < kEnough * seconds(kListenFor_ns) / config.period_s)
      throw InputError(settings + setting + ": " + std::to_string(count) + " " + what +
                       " messages in 0.5 s, but the loop needs one each period of " +
                       std::to_string(config.period_s * 1e3) + " ms");
  };
  require_each_period(estimates, "encoder_msg_rate_ms", "encoder");
  if (closes_loop(config.drive_mode)) require_each_period(torques, "torques_msg_rate_ms", "torque");
  if (!temperature)
    throw InputError(
        settings +
        "temperature_msg_rate_ms: no temperature within 0.5 s; set it, or temperature_source = \"none\"");
}

void release_axis(CanPort& port, const DriveConfig& config) {
  if (!closes_loop(config.drive_mode)) send(port, config, torque_frame(config.node_id, 0.0));
  send(port, config, axis_state_frame(config.node_id, AxisState::kIdle));
}

}  // namespace strainwave::odrive
