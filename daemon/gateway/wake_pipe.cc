// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/wake_pipe.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace strainwave {

WakePipe::WakePipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::system_error(errno, std::generic_category(), "making the gateway's wake pipe");
  core_end_.reset(ends[0]);
  gateway_end_.reset(ends[1]);
}

void WakePipe::take() noexcept {
  std::array<char, 4096> wakes;
  if (::read(core_end_.get(), wakes.data(), wakes.size()) <= 0) return;
}

}  // namespace strainwave
