#include "daemon/realtime/dma_latency.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace strainwave {

DmaLatency::~DmaLatency() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::string DmaLatency::request() {
  constexpr const char* kPath = "/dev/cpu_dma_latency";
  descriptor_ = ::open(kPath, O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0 && errno == ENOENT) return "";
  const std::int32_t latency_us = 0;
  if (descriptor_ >= 0 && ::write(descriptor_, &latency_us, sizeof latency_us) == sizeof latency_us)
    return "";
  return std::string(kPath) + " cannot be written (" + std::generic_category().message(errno) +
         "): wake-ups may be late by the sleep states' exit times; allow the service to write it";
}

}  // namespace strainwave
