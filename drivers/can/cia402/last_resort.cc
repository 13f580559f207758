// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/last_resort.h"

#include <array>

#include "drivers/can/canopen/canopen.h"
#include "drivers/can/canopen/canopen_sdo.h"
#include "drivers/can/cia402/cia402_state.h"

namespace strainwave::cia402 {

namespace {

constexpr int kDisables = 3;
constexpr int kResets = 2;
constexpr std::int64_t kBetween_ns = 10'000'000;
/// A message so long after the reset shows that the drive did not obey it.
constexpr std::int64_t kObeysWithin_ns = 100'000'000;

}  // namespace

void LastResort::begin(std::int64_t now_ns) noexcept {
  if (step_ != Step::kIdle) return;
  step_ = Step::kDisabling;
  disables_sent_ = resets_sent_ = 0;
  next_ns_ = now_ns;
}

void LastResort::hear(std::int64_t now_ns) noexcept {
  if (step_ != Step::kWatching || now_ns - reset_ns_ <= kObeysWithin_ns) return;
  step_ = resets_sent_ < kResets ? Step::kResetting : Step::kWithdrawn;
}

CanFrame LastResort::frame() const noexcept {
  if (step_ == Step::kResetting) return canopen::nmt_frame(canopen::NmtCommand::kResetNode, node_id_);
  return canopen::expedited_download(node_id_, {0x6040, 0}, controlword::kDisableVoltage, 2);
}

void LastResort::sent(std::int64_t now_ns) noexcept {
  next_ns_ = now_ns + kBetween_ns;
  if (step_ == Step::kResetting) {
    ++resets_sent_;
    reset_ns_ = now_ns;
    step_ = Step::kWatching;
  } else if (++disables_sent_ == kDisables) {
    step_ = Step::kResetting;
  }
}

}  // namespace strainwave::cia402
