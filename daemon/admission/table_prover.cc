// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/table_prover.h"

#include <utility>

namespace strainwave {

void TableProver::start() {
  thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

bool TableProver::hand_over(Verdict& order) {
  const std::lock_guard lock(mutex_);
  if (occupied_) return false;
  occupied_ = true;
  order_ = std::move(order);
  handed_over_.notify_one();
  return true;
}

std::optional<TableProver::Proved> TableProver::take() {
  const std::lock_guard lock(mutex_);
  if (!proved_) return std::nullopt;
  occupied_ = false;
  return std::exchange(proved_, std::nullopt);
}

void TableProver::work(const std::stop_token& stop) {
  for (;;) {
    std::unique_lock lock(mutex_);
    if (!handed_over_.wait(lock, stop, [this] { return order_.has_value(); })) return;
    Verdict order = *std::exchange(order_, std::nullopt);
    lock.unlock();
    TableVerdict box = judge_box(*order.table);
    lock.lock();
    proved_ = Proved{std::move(order), std::move(box)};
  }
}

}  // namespace strainwave
