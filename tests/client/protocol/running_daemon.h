// SPDX-License-Identifier: BSD-3-Clause
// The fake daemon in its own thread on a real LCM network.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

#include "tests/client/protocol/fake_daemon.h"
#include "tests/support/own_port.h"

namespace strainwave {

using testing::own_url;

/// A joint that obeys every order and publishes its state all the time.
class RunningDaemon {
 public:
  explicit RunningDaemon(const std::string& url) : connection_(url), daemon_(connection_, "SW", "elbow") {
    daemon_.state.mode = static_cast<std::int32_t>(Mode::kHolding);
    thread_ = std::thread([this] { run(); });
  }
  ~RunningDaemon() { stop(); }
  /// Stops the daemon for good.
  void stop() {
    stop_ = true;
    if (thread_.joinable()) thread_.join();
  }
  /// Publishes and answers nothing more, but still receives.
  void fall_silent() noexcept { silent_ = true; }
  FakeDaemon& daemon() noexcept { return daemon_; }  ///< set up before the first order, read after stop()
  std::int64_t cycle() const noexcept { return cycle_; }  ///< cycle of the latest state

 private:
  void run() {
    while (!stop_) {
      if (silent_) daemon_.drop = 1;
      while (connection_.handle(1)) {
        if (silent_) daemon_.drop = 1;
      }
      if (silent_) continue;
      daemon_.publish_state();
      cycle_ = daemon_.state.cycle;
      if (cycle_ % kLimitsEvery == 1) daemon_.publish_limits();
    }
  }

  static constexpr std::int64_t kLimitsEvery = 50;

  Connection connection_;
  FakeDaemon daemon_;
  std::atomic<bool> stop_{false};
  std::atomic<bool> silent_{false};
  std::atomic<std::int64_t> cycle_{0};
  std::thread thread_;
};

}  // namespace strainwave
