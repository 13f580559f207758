// strainwave-gateway: started by strainwaved with three descriptors, never by hand.
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cstdio>
#include <exception>

#include "daemon/gateway/gateway.h"
#include "daemon/gateway_process.h"

namespace {

// How long to wait for orders before looking for states to publish: half a period of the fastest usual state rate.
constexpr int kTurn_ms = 2;

int run() {
  using namespace strainwave;
  // Without its core it has no purpose.
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  const pid_t parent = ::getppid();
  const MemoryFile outbound_file = MemoryFile::open(kGatewayOutboundFd, sizeof(OutboundMemory), false);
  const MemoryFile inbound_file = MemoryFile::open(kGatewayInboundFd, sizeof(InboundMemory), true);
  const auto& outbound = *static_cast<const OutboundMemory*>(outbound_file.address());
  auto& inbound = *static_cast<InboundMemory*>(inbound_file.address());
  if (outbound.magic != kSharedMemoryMagic) {
    std::fputs("strainwave-gateway: the shared memory is not strainwaved's\n", stderr);
    return 1;
  }
  Gateway gateway(outbound, inbound, kGatewayWakeFd);
  if (!gateway.good()) {
    std::fprintf(stderr, "strainwave-gateway: %s\n", gateway.problem().c_str());
    return kGatewayExitNoLcm;
  }
  inbound.ready.store(1, std::memory_order_release);
  while (::getppid() == parent) gateway.turn(kTurn_ms);
  return 0;
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
