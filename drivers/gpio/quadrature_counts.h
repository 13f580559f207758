// SPDX-License-Identifier: BSD-3-Clause
// The fallback without a hardware counter: a thread counts the edges of the encoder lines. It suits slow
// joints only; docs/gpio.md gives the limit. read() and clear_fault() are real-time safe; the constructor
// starts the thread.
#pragma once

#include <atomic>
#include <thread>

#include "drivers/gpio/count_source.h"
#include "drivers/gpio/quadrature_decoder.h"

namespace strainwave {

struct QuadratureConfig {
  /// A higher cap is refused. It is the highest rate that tests/vm/gpio counts without a loss; see
  /// docs/gpio.md.
  static constexpr double kHighestRate_Hz = 5000.0;

  LineOptions a;
  LineOptions b;
  double max_rate_Hz = 1000.0;  ///< edges of both lines together; a higher rate is a fault
  int priority = 70;            ///< SCHED_FIFO priority of the thread, if permitted; 0: a normal thread
  std::int64_t (*clock_ns)() noexcept = nullptr;  ///< CLOCK_MONOTONIC; required
};

class QuadratureCounts final : public CountSource {
 public:
  /// The position is stale when the thread has not run for this time.
  static constexpr std::int64_t kSilence_ns = 100'000'000;

  /// Throws InputError for missing or held lines and for a chip without interrupts.
  QuadratureCounts(const QuadratureConfig& config, const std::string& consumer, const std::string& where);
  ~QuadratureCounts() override;

  Sample read(std::int64_t now_ns) noexcept override;
  /// Counting continues from the present levels; missed counts stay missing.
  void clear_fault() noexcept override { clear_requested_.store(true); }

  QuadratureFault fault() const noexcept { return fault_.load(); }

 private:
  void run(const std::stop_token& stop);
  void make_real_time() const;
  void decode() noexcept;
  void compare_levels() noexcept;
  void begin_anew() noexcept;

  QuadratureConfig config_;
  EdgeEvents edges_;
  QuadratureDecoder decoder_;
  std::uint32_t last_sequence_ = 0;
  bool levels_differed_ = false;  ///< the last comparison found a difference, and no edge has followed
  std::atomic<std::int64_t> counts_{0};
  std::atomic<QuadratureFault> fault_{QuadratureFault::kNone};
  std::atomic<std::int64_t> looked_ns_;
  std::atomic<bool> clear_requested_{false};
  std::jthread thread_;  // last member, so that the thread ends first
};

}  // namespace strainwave
