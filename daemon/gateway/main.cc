// strainwave-gateway: started by strainwaved with three descriptors, never by hand.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "daemon/gateway/confinement.h"
#include "daemon/gateway/gateway.h"
#include "daemon/gateway/gateway_process.h"

namespace {

// How long to wait for orders before looking for states to publish: half a period of the fastest usual state rate.
constexpr int kTurn_ms = 2;

int run() {
  using namespace strainwave;
  // It was started by descriptor, which says nothing to people.
  ::prctl(PR_SET_NAME, "strainwave-gateway");
  const MemoryFile outbound_file = MemoryFile::open(kGatewayOutboundFd, sizeof(OutboundMemory), false);
  const MemoryFile inbound_file = MemoryFile::open(kGatewayInboundFd, sizeof(InboundMemory), true);
  const auto& outbound = *static_cast<const OutboundMemory*>(outbound_file.address());
  auto& inbound = *static_cast<InboundMemory*>(inbound_file.address());
  if (outbound.magic != kSharedMemoryMagic) {
    std::fputs("strainwave-gateway: the shared memory is not strainwaved's\n", stderr);
    return 1;
  }
  give_up_privileges(outbound.gateway_uid, outbound.gateway_gid, kGatewayFirstFreeFd);
  // Without its core it has no purpose. (After the change of user, which clears this.)
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const auto core_lives = [&] { return ::getppid() == outbound.core_pid; };
  Gateway gateway(outbound, inbound, kGatewayWakeFd);
  if (!gateway.good()) {
    std::fprintf(stderr, "strainwave-gateway: %s\n", gateway.problem().c_str());
    return kGatewayExitNoLcm;
  }
  // Everything is open and bound, and nothing that came in has been read: that begins with the first turn.
  confine();
  inbound.ready.store(1, std::memory_order_release);
  while (core_lives()) {
    gateway.turn(kTurn_ms);
    inbound.turns.fetch_add(1, std::memory_order_relaxed);
  }
  // No more is allowed; ending without a core needs no more either.
  ::_exit(0);
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strainwave-gateway: %s: it is started by strainwaved, not by hand\n", error.what());
    return 1;
  }
}
