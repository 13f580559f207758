// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/service_notifier.h"

#include <systemd/sd-daemon.h>

#include <algorithm>

namespace strainwave {

namespace {

constexpr std::int64_t kCyclesUntilReady = 100;
constexpr std::int64_t kLongestSilence_ns = 200'000'000;
/// Messages within the watchdog's time; some may be late when the machine is busy.
constexpr std::int64_t kMessagesPerWatchdog = 4;

std::int64_t alive_every_ns() {
  std::uint64_t watchdog_us = 0;
  if (::sd_watchdog_enabled(0, &watchdog_us) <= 0) return kLongestSilence_ns;
  return std::min(kLongestSilence_ns, static_cast<std::int64_t>(watchdog_us) * 1000 / kMessagesPerWatchdog);
}

}  // namespace

ServiceNotifier::ServiceNotifier() : timing_(kCyclesUntilReady), alive_every_ns_(alive_every_ns()) {}

void ServiceNotifier::update(std::int64_t cycles, std::int64_t overruns, std::int64_t now_ns) {
  if (!ready_ && timing_.update(cycles, overruns)) {
    ready_ = true;
    ::sd_notify(0, "READY=1");
  }
  if (now_ns < alive_due_ns_) return;
  alive_due_ns_ = now_ns + alive_every_ns_;
  // Only a running loop may keep the service alive.
  if (cycles > alive_cycles_) ::sd_notify(0, "WATCHDOG=1");
  alive_cycles_ = cycles;
}

void ServiceNotifier::show(const std::string& status) {
  if (status == shown_) return;
  shown_ = status;
  ::sd_notify(0, ("STATUS=" + status).c_str());
}

void ServiceNotifier::stopping() {
  ::sd_notify(0, "STOPPING=1");
}

}  // namespace strainwave
