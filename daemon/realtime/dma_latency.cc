// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/dma_latency.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace strainwave {

std::string DmaLatency::request(const std::filesystem::path& file) {
  descriptor_ = UniqueFd(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  if (!descriptor_ && errno == ENOENT) return "";
  const std::int32_t latency_us = 0;
  if (descriptor_ && ::write(descriptor_.get(), &latency_us, sizeof latency_us) == sizeof latency_us)
    return "";
  return file.string() + " cannot be written (" + std::generic_category().message(errno) +
         "): wake-ups may be late by the sleep states' exit times; allow the service to write it";
}

}  // namespace strainwave
