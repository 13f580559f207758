// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/quadrature_counts.h"

#include <poll.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>

#include <array>

namespace strainwave {

namespace {
/// Interval of the comparison of levels when no edge comes.
constexpr int kIdle_ms = 10;
}  // namespace

QuadratureCounts::QuadratureCounts(const QuadratureConfig& config, const std::string& consumer,
                                   const std::string& where)
    : config_(config),
      edges_(std::array{config.a, config.b}, EdgeKind::kBoth, consumer, where),
      decoder_(config.max_rate_Hz),
      looked_ns_(config.clock_ns()) {
  begin_anew();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

QuadratureCounts::~QuadratureCounts() = default;

void QuadratureCounts::make_real_time() const {
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  const sched_param parameters{config_.priority};
  // Without the privilege the thread stays normal; the kernel's buffer then bridges delays, up to its size.
  ::pthread_setschedparam(::pthread_self(), config_.priority > 0 ? SCHED_FIFO : SCHED_OTHER, &parameters);
}

void QuadratureCounts::run(const std::stop_token& stop) {
  make_real_time();
  while (!stop.stop_requested()) {
    pollfd descriptor{edges_.descriptor(), POLLIN, 0};
    const int ready = ::poll(&descriptor, 1, kIdle_ms);
    if (clear_requested_.exchange(false)) begin_anew();
    if (ready > 0)
      decode();
    else
      compare_levels();
    counts_.store(decoder_.count());
    fault_.store(decoder_.fault());
    looked_ns_.store(config_.clock_ns());
  }
}

void QuadratureCounts::decode() noexcept {
  std::array<Edge, EdgeEvents::kReadAtOnce> edges;
  const int count = edges_.read(edges);
  if (count < 0) return decoder_.fail(QuadratureFault::kDeviceGone);
  levels_differed_ = false;
  for (int i = 0; i < count; ++i) {
    last_sequence_ = edges[static_cast<std::size_t>(i)].sequence;
    (void)decoder_.apply(edges[static_cast<std::size_t>(i)]);
  }
}

// Without pending edges the levels must match the decoded ones. Only two differences in a row are a fault: a
// real-time kernel delivers events in a thread, so a level may be visible before its edge.
void QuadratureCounts::compare_levels() noexcept {
  std::uint32_t levels = 0;
  if (!edges_.levels(levels)) return decoder_.fail(QuadratureFault::kDeviceGone);
  pollfd descriptor{edges_.descriptor(), POLLIN, 0};
  const bool differ = ::poll(&descriptor, 1, 0) == 0 && levels != decoder_.levels();
  if (differ && levels_differed_) decoder_.fail(QuadratureFault::kLostEvents);
  levels_differed_ = differ;
}

void QuadratureCounts::begin_anew() noexcept {
  std::array<Edge, EdgeEvents::kReadAtOnce> old;
  for (int count = edges_.read(old); count > 0; count = edges_.read(old))
    last_sequence_ = old[static_cast<std::size_t>(count - 1)].sequence;
  std::uint32_t levels = 0;
  if (!edges_.levels(levels)) return decoder_.fail(QuadratureFault::kDeviceGone);
  decoder_.reset((levels & 1U) != 0, (levels & 2U) != 0, last_sequence_);
}

CountSource::Sample QuadratureCounts::read(std::int64_t now_ns) noexcept {
  const std::int64_t counts = counts_.load();
  if (fault_.load() != QuadratureFault::kNone) return {counts, State::kImplausible};
  return {counts, now_ns - looked_ns_.load() > kSilence_ns ? State::kStale : State::kFresh};
}

}  // namespace strainwave
