// Keeps the processors out of deep sleep states while it lives: their wake-up would add to every period. Not real-time.
#pragma once

#include <string>

namespace strainwave {

class DmaLatency {
 public:
  DmaLatency() = default;
  ~DmaLatency();
  DmaLatency(const DmaLatency&) = delete;
  DmaLatency& operator=(const DmaLatency&) = delete;

  /// Asks for no exit latency by /dev/cpu_dma_latency, in force while the file stays open. Empty when granted, else why
  /// not and what to do; a machine without that file (a virtual one) has nothing to ask for.
  std::string request();

 private:
  int descriptor_ = -1;
};

}  // namespace strainwave
