// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/loop/overrun_watch.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace strainwave {

namespace {

std::int64_t whole_periods(double duration_s, double period_s) noexcept {
  return std::max<std::int64_t>(1, std::llround(duration_s / period_s));
}

}  // namespace

OverrunWatch::OverrunWatch(const OverrunLimits& limits, double period_s) noexcept
    : in_a_row_limit_(limits.in_a_row),
      stall_limit_periods_(whole_periods(limits.stall_s, period_s)),
      missed_limit_periods_(static_cast<std::int64_t>(limits.missed_share * kWindow_s / period_s)),
      slot_periods_(whole_periods(kWindow_s / static_cast<double>(kSlots), period_s)) {}

Fault OverrunWatch::judge(std::int64_t skipped) noexcept {
  in_a_row_ = skipped > 0 ? in_a_row_ + 1 : 0;
  count(skipped);
  Fault fault = Fault::kNone;
  if (1 + skipped > stall_limit_periods_ && skipped > 0)
    fault = Fault::kLoopStalled;
  else if (in_a_row_ >= in_a_row_limit_)
    fault = Fault::kOverruns;
  else if (missed() > missed_limit_periods_)
    fault = Fault::kPeriodsMissed;
  if (fault == Fault::kNone) return fault;
  in_a_row_ = 0;
  missed_.fill(0);
  return fault;
}

void OverrunWatch::count(std::int64_t skipped) noexcept {
  in_slot_periods_ += 1 + skipped;
  for (std::size_t turned = 0; in_slot_periods_ >= slot_periods_ && turned < kSlots; ++turned) {
    in_slot_periods_ -= slot_periods_;
    slot_ = (slot_ + 1) % kSlots;
    missed_[slot_] = 0;
  }
  in_slot_periods_ %= slot_periods_;
  missed_[slot_] += skipped;
}

std::int64_t OverrunWatch::missed() const noexcept {
  return std::min(std::accumulate(missed_.begin(), missed_.end(), std::int64_t{0}),
                  static_cast<std::int64_t>(kSlots) * slot_periods_);
}

}  // namespace strainwave
