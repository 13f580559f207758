// SPDX-License-Identifier: BSD-3-Clause
// strainwave-gateway: started by strainwaved, or for it by the service manager; never by hand.
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <string>
#include <thread>

#include "daemon/gateway/confinement.h"
#include "daemon/gateway/gateway.h"
#include "daemon/gateway/gateway_activation.h"
#include "daemon/gateway/gateway_process.h"
#include "daemon/gateway/preference.h"
#include "daemon/gateway/service_watchdog.h"
#include "daemon/gateway/steady_now.h"
#include "lcmtypes/multicast_check.h"

namespace {

// How long to wait for orders before looking for states to publish: half a period of the fastest usual state rate.
constexpr int kTurn_ms = 2;

/// Whether the core runs and wants this gateway.
bool core_is_there() {
  pollfd core{strainwave::kGatewayCoreFd, POLLRDHUP, 0};
  return ::poll(&core, 1, 0) == 0;
}

/// Returns false if the core has gone.
bool wait_for_network(const strainwave::OutboundMemory& outbound, strainwave::InboundMemory& inbound,
                      strainwave::ServiceWatchdog& watchdog) {
  const std::string url(outbound.lcm_url.view());
  return strainwave::wait_for_multicast(
      url,
      [&](const std::string& problem) {
        std::fprintf(
            stderr,
            "strainwave-gateway: waiting for LCM on '%s'; no client reaches the daemon until then: %s\n",
            url.c_str(), problem.c_str());
      },
      [&] {
        watchdog.alive(strainwave::steady_now_ns());
        inbound.turns.fetch_add(1, std::memory_order_relaxed);
        return core_is_there();
      });
}

int run() {
  using namespace strainwave;
  if (is_activated()) become_gateway_of_core();
  // The process was started by descriptor, so its default name would tell people nothing.
  ::prctl(PR_SET_NAME, "strainwave-gateway");
  const MemoryFile outbound_file = MemoryFile::open(kGatewayOutboundFd, sizeof(OutboundMemory), false);
  const MemoryFile inbound_file = MemoryFile::open(kGatewayInboundFd, sizeof(InboundMemory), true);
  const auto& outbound = *static_cast<const OutboundMemory*>(outbound_file.address());
  auto& inbound = *static_cast<InboundMemory*>(inbound_file.address());
  if (outbound.magic != kSharedMemoryMagic) {
    std::fputs("strainwave-gateway: the shared memory is not strainwaved's\n", stderr);
    return 1;
  }
  (void)prefer_this_thread();  // the core reports a refusal
  give_up_privileges(outbound.gateway_uid, outbound.gateway_gid, kGatewayFirstFreeFd);
  // The gateway ends with its core, even if it hangs. (After the change of user, which clears this setting.)
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  ServiceWatchdog watchdog;
  watchdog.ready();
  if (!wait_for_network(outbound, inbound, watchdog)) return 0;
  Gateway gateway(outbound, inbound, kGatewayWakeFd);
  if (!gateway.good()) {
    std::fprintf(stderr, "strainwave-gateway: %s\n", gateway.problem().c_str());
    return kGatewayExitNoLcm;
  }
  // Everything is open and bound, and the gateway reads no datagram before its first turn.
  confine();
  inbound.ready.store(1, std::memory_order_release);
  while (core_is_there()) {
    if (!gateway.turn(kTurn_ms)) {
      inbound.deaf.fetch_add(1, std::memory_order_relaxed);
      ::_exit(kGatewayExitDeaf);
    }
    watchdog.alive(strainwave::steady_now_ns());
    inbound.turns.fetch_add(1, std::memory_order_relaxed);
  }
  // The filter allows no further clean-up, and without a core none is needed.
  ::_exit(0);
}

}  // namespace

int main(int count, char**) {
  if (count > 1) {
    std::fputs(
        "strainwave-gateway: takes no options: strainwaved or the service manager starts it, never a user "
        "(docs/security.md)\n",
        stderr);
    return 2;
  }
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strainwave-gateway: %s: only strainwaved starts this program\n", error.what());
    return 1;
  }
}
