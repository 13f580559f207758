// SPDX-License-Identifier: BSD-3-Clause
// A fake daemon for the client's tests. It receives the orders of one joint and drops, answers or refuses them as the test says. It publishes the
// states that the test lists. It works on any LCM network; on memq:// it shares the client's connection.
#pragma once

#include <chrono>
#include <functional>
#include <strainwave/ack_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <string>
#include <thread>
#include <vector>

#include "client/protocol/connection.h"
#include "lcmtypes/channels.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

class FakeDaemon {
 public:
  struct Heard {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  FakeDaemon(Connection& connection, std::string prefix, std::string joint);

  /// Orders received, including the dropped ones.
  const std::vector<Heard>& heard() const noexcept { return heard_; }

  /// Publishes `state`; with an argument, sets its mode first.
  void publish_state();
  void publish_state(Mode mode);
  void publish_limits();
  /// From the next state on, the joint has yielded to 13.1042 N.m towards positive positions at 0.3011 rad, with a limit of 12 N.m.
  void show_yield();

  state_v1 state{};
  limits_v1 limits{};
  int drop = 0;  ///< number of orders that get no answer
  Reason reason = Reason::kAccepted;
  std::string text;
  std::int64_t last_sequence = 0;        ///< sequence that the answer reports as the last accepted one
  std::int64_t sequence_error = 0;       ///< added to the sequence that the answer quotes
  std::string answers_as;                ///< joint on whose channel the answers go out; empty: its own
  bool obeys_moves = true;               ///< an accepted setpoint becomes state.target_position_rad
  std::vector<Mode> modes_after_answer;  ///< published after each answer, in order
  std::function<void()> after_answer;    ///< called after each answer, before modes_after_answer

 private:
  void on_order(const ReceivedMessage& message);
  void answer(std::int64_t sender_id, std::int64_t sequence);

  Connection& connection_;
  std::string prefix_;
  std::string joint_;
  std::vector<Heard> heard_;
  Subscription subscription_;
};

/// While it lives, each state of the daemon triggers the next one a few milliseconds later.
class StateAfterState {
 public:
  StateAfterState(Connection& connection, FakeDaemon& daemon)
      : daemon_(daemon),
        states_(connection.subscribe("SW\\.elbow\\.STATE", &StateAfterState::on_state, this)) {}

 private:
  void on_state(const ReceivedMessage&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
    daemon_.publish_state();
  }

  FakeDaemon& daemon_;
  Subscription states_;
};

}  // namespace strainwave
