// SPDX-License-Identifier: BSD-3-Clause
// Proves tables' boxes in a thread of its own: a proof may take seconds, in which the supervisor goes on obeying stops. One table at
// a time. Not real-time.
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
  /// The order of a table, and what became of its box.
  struct Proved {
    Verdict order;
    TableVerdict box;
  };

  /// Waits for the proof that is under way.
  ~TableProver() = default;
  TableProver() = default;
  TableProver(const TableProver&) = delete;
  TableProver& operator=(const TableProver&) = delete;

  /// Begins the thread; what is handed over before waits for it.
  void start();

  /// Takes the order of a table over. False, and nothing is taken, until the one before it was taken back.
  bool hand_over(Verdict& order);

  /// The order whose box was judged, or nothing yet.
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
