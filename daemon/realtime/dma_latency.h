// SPDX-License-Identifier: BSD-3-Clause
// Keeps the processors out of deep sleep states while it lives: their wake-up would add to every period. Not real-time.
#pragma once

#include <filesystem>
#include <string>

#include "base/unique_fd.h"

namespace strainwave {

class DmaLatency {
 public:
  /// Requests an exit latency of 0 through `file`, in force while the file stays open. Empty when granted, else why
  /// not and what to do; a machine without that file (a virtual one) has nothing to ask for.
  std::string request(const std::filesystem::path& file = "/dev/cpu_dma_latency");

 private:
  UniqueFd descriptor_;
};

}  // namespace strainwave
