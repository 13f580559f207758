// SPDX-License-Identifier: BSD-3-Clause
// Proves the boxes of tables in a separate thread: a proof may take seconds, and the supervisor must obey stops meanwhile. One table
// at a time. Not real-time.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "daemon/admission/admission.h"
#include "daemon/admission/table_admission.h"

namespace strainwave {

class TableProver {
 public:
  /// The order of a table, and the verdict on its box.
  struct Proved {
    Verdict order;
    TableVerdict box;
  };

  /// Waits for the proof that is under way.
  ~TableProver() = default;
  TableProver() = default;
  TableProver(const TableProver&) = delete;
  TableProver& operator=(const TableProver&) = delete;

  /// Starts the thread; an order that was handed over earlier waits for it.
  void start();

  /// Accepts a table's order. Returns false, and leaves `order` alone, until take() has returned the previous one.
  bool hand_over(Verdict& order);

  /// Returns the order whose box was judged; nothing while there is none.
  std::optional<Proved> take();

 private:
  void work(const std::stop_token& stop);

  std::mutex mutex_;
  std::condition_variable_any handed_over_;
  std::optional<Verdict> order_;
  std::optional<Proved> proved_;
  bool occupied_ = false;  ///< from hand_over() to take()
  std::jthread thread_;    ///< the last member: it uses the others
};

}  // namespace strainwave
