// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway_guard.h"

#include <spdlog/spdlog.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "base/printable.h"
#include "daemon/realtime/loop/periodic_clock.h"

namespace strainwave {

namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;

std::string user_of(const DaemonConfig& config) {
  if (!config.gateway_socket.empty()) return "as a service with a user of its own";
  if (config.gateway_user.name.empty()) return "as the daemon's own user";
  return "as user " + config.gateway_user.name;
}

std::uint64_t count(const std::atomic<std::uint64_t>& value) {
  return value.load(std::memory_order_relaxed);
}

}  // namespace

GatewayGuard::GatewayGuard(const DaemonConfig& config, GatewayProcess::Descriptors descriptors,
                           const InboundMemory& inbound)
    : prefix_(config.prefix),
      user_(user_of(config)),
      process_(find_gateway_program(), descriptors, config.gateway_socket),
      inbound_(inbound),
      dropped_log_(1, 10'000 * kMillisecond_ns) {}

bool GatewayGuard::start(const std::function<bool()>& wanted) {
  process_.start(monotonic_now_ns());
  while (inbound_.ready.load(std::memory_order_acquire) == 0) {
    const std::int64_t now_ns = monotonic_now_ns();
    if (const auto end = process_.take_end(now_ns))
      throw std::runtime_error(
          "the gateway ended with " + *end +
          (process_.last_exit_status() == kGatewayExitNoLcm ? ": LCM is not available, see above" : ""));
    if (pulse_.hangs(process_.started_ns(), count(inbound_.turns), now_ns))
      throw std::runtime_error("the gateway did not become ready in 5 s");
    if (!wanted()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  spdlog::info("gateway: {}, ready after {} ms", user_,
               (monotonic_now_ns() - process_.started_ns()) / kMillisecond_ns);
  return true;
}

void GatewayGuard::watch(bool wanted, std::int64_t now_ns) {
  log_deafness();
  if (const auto end = process_.take_end(now_ns))
    spdlog::error("the gateway ended with {}: starting it again", *end);
  if (wanted && process_.start_due(now_ns)) restart(now_ns);
  end_hung(now_ns);
  log_dropped_datagrams(now_ns);
  log_foreign_states();
}

void GatewayGuard::restart(std::int64_t now_ns) {
  try {
    process_.start(now_ns);
  } catch (const std::system_error& error) {
    spdlog::error("{}", error.what());
  }
}

void GatewayGuard::end_hung(std::int64_t now_ns) {
  if (!pulse_.hangs(process_.started_ns(), count(inbound_.turns), now_ns) || !process_.running()) return;
  spdlog::error(
      "the gateway has done nothing for {} s: ending it; messages and stops sent to it meanwhile are lost",
      pulse_.patience_s());
  process_.kill();
}

void GatewayGuard::log_dropped_datagrams(std::int64_t now_ns) {
  const std::uint64_t malformed = count(inbound_.malformed);
  const std::uint64_t too_long = count(inbound_.too_long);
  const std::uint64_t interrupted = count(inbound_.interrupted);
  const std::uint64_t crowded_out = count(inbound_.crowded_out);
  const std::uint64_t dropped = malformed + too_long + interrupted + crowded_out;
  std::int64_t suppressed = 0;
  if (dropped == dropped_seen_ || !dropped_log_.allow(now_ns, suppressed)) return;
  dropped_seen_ = dropped;
  spdlog::warn(
      "the gateway has dropped since its start: {}, {} too long, {} with missing fragments, {} too many at "
      "once",
      counted(malformed, "malformed datagram"), too_long, counted(interrupted, "message"),
      counted(crowded_out, "message"));
}

void GatewayGuard::log_deafness() {
  const std::uint64_t deaf = count(inbound_.deaf);
  if (deaf != deaf_seen_)
    spdlog::error(
        "the gateway does not receive its own messages: the network's adapter or route was removed or "
        "changed. No command and no stop reaches the daemon until a new gateway has joined the group");
  deaf_seen_ = deaf;
}

void GatewayGuard::log_foreign_states() {
  const std::uint64_t foreign = count(inbound_.foreign_states);
  if (foreign != foreign_states_seen_ && foreign_states_seen_ == 0)
    spdlog::error("another daemon on this LCM bus publishes on prefix {}: give each its own daemon.prefix",
                  prefix_);
  foreign_states_seen_ = foreign;
}

}  // namespace strainwave
