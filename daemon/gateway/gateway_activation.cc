// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/gateway_activation.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "base/unique_fd.h"
#include "daemon/gateway/descriptor_message.h"
#include "daemon/gateway/gateway_process.h"

extern char** environ;

namespace strainwave {

namespace {

/// sd_listen_fds(3)
constexpr int kFirstListenFd = 3;

}  // namespace

// NOLINTBEGIN(concurrency-mt-unsafe): one thread
bool is_activated() {
  const char* process = ::getenv("LISTEN_PID");
  return process != nullptr && process == std::to_string(::getpid());
}

void become_gateway_of_core() {
  // Above the numbers that the descriptors get in the end.
  constexpr int kAway = 64;
  const auto away = [](int descriptor) {
    const UniqueFd here(descriptor);
    const int moved = ::fcntl(here.get(), F_DUPFD, kAway);
    if (moved < 0) throw std::system_error(errno, std::generic_category(), "taking the core's descriptors");
    return moved;
  };
  const int core = away(kFirstListenFd);
  const std::array<int, kPassedDescriptors> passed = receive_descriptors(core);
  const int program = away(passed[3]);
  const std::array<int, 4> from{away(passed[0]), away(passed[1]), away(passed[2]), core};
  const std::array<int, 4> to{kGatewayOutboundFd, kGatewayInboundFd, kGatewayWakeFd, kGatewayCoreFd};
  for (std::size_t i = 0; i < from.size(); ++i)
    if (::dup2(from[i], to[i]) < 0)
      throw std::system_error(errno, std::generic_category(), "placing the core's descriptors");
  for (const char* name : {"LISTEN_PID", "LISTEN_FDS", "LISTEN_FDNAMES"}) ::unsetenv(name);
  std::string name = "strainwave-gateway";
  std::array<char*, 2> arguments{name.data(), nullptr};
  ::execve(("/proc/self/fd/" + std::to_string(program)).c_str(), arguments.data(), environ);
  throw std::system_error(errno, std::generic_category(), "becoming the core's gateway");
}
// NOLINTEND(concurrency-mt-unsafe)

}  // namespace strainwave
