// SPDX-License-Identifier: BSD-3-Clause
// A client that talks to the daemon over LCM like any program. It shares no code with strainwavectl.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <optional>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/timing_v1.hpp>
#include <string>
#include <vector>

#include "control/table/gain_table.h"
#include "strainwave/vocabulary.h"

namespace strainwave::testing {

/// The answer to an order.
struct Answer {
  bool accepted = false;
  Reason reason = Reason::kTimedOut;
  std::string text;
};

inline constexpr const char* kTestUrl = "udpm://239.255.76.67:7667?ttl=0";

class TestClient {
 public:
  explicit TestClient(std::string prefix = "SW", const std::string& lcm_url = kTestUrl);

  /// Handles all messages that arrive within `duration`.
  void pump(std::chrono::milliseconds duration);
  /// Pumps until `condition` holds for the latest state of `joint`; false after `timeout`.
  bool wait_for_state(const std::string& joint, const std::function<bool(const state_v1&)>& condition,
                      std::chrono::milliseconds timeout = std::chrono::seconds(10));
  bool wait_for_mode(const std::string& joint, Mode mode,
                     std::chrono::milliseconds timeout = std::chrono::seconds(10));
  const std::optional<state_v1>& state(const std::string& joint) { return states_[joint]; }
  /// All states of `joint` since the last call of forget_states().
  const std::vector<state_v1>& history(const std::string& joint) { return history_[joint]; }
  void forget_states() { history_.clear(); }
  const std::optional<timing_v1>& timing() const { return timing_; }
  /// Pumps until a TIMING message newer than the last one arrives.
  bool wait_for_timing(std::chrono::milliseconds timeout = std::chrono::seconds(5));

  Answer command(const std::string& joint, Action action);
  Answer move(const std::string& joint, double position_rad, double valid_for_s = 0.0);
  /// The next setpoint of a stream begins a new stream.
  void begin_stream() {
    ++stream_id_;
    stream_begins_ = true;
  }
  Answer load(const std::string& joint, const GainTable& table);

  /// The messages themselves, for tests that change them before sending.
  command_v1 make_command(const std::string& joint, Action action);
  setpoint_v1 make_setpoint(const std::string& joint, double position_rad, double valid_for_s = 0.0);
  gain_table_v1 make_table(const std::string& joint, const GainTable& table);
  inject_v1 make_injection(const std::string& joint, std::int32_t kind, double for_s, double amount);
  template <typename Message>
  Answer send_and_wait(const std::string& joint, const char* kind, const Message& message) {
    lcm_.publish(prefix_ + "." + joint + "." + kind, &message);
    return wait_for_answer(message.sequence);
  }
  Answer wait_for_answer(std::int64_t sequence, std::chrono::milliseconds timeout = std::chrono::seconds(5));
  lcm::LCM& lcm() { return lcm_; }
  std::int64_t sender_id() const { return sender_id_; }

 private:
  void on_state(const lcm::ReceiveBuffer*, const std::string& channel, const state_v1* message);
  void on_ack(const lcm::ReceiveBuffer*, const std::string& channel, const ack_v1* message);
  void on_timing(const lcm::ReceiveBuffer*, const std::string& channel, const timing_v1* message);
  void note_stop(const std::string& joint);
  template <typename Message>
  void fill_envelope(const std::string& joint, Message& message);

  std::string prefix_;
  lcm::LCM lcm_;
  std::int64_t sender_id_;
  std::int64_t sequence_ = 0;
  std::int64_t stream_id_ = 1;
  bool stream_begins_ = true;
  std::map<std::string, std::optional<state_v1>> states_;
  std::map<std::string, std::int64_t> heard_us_;           ///< when the latest state arrived
  std::map<std::string, std::int64_t> stopped_challenge_;  ///< of the last stop
  std::map<std::string, std::int64_t> stopped_us_;         ///< likewise
  std::map<std::string, std::vector<state_v1>> history_;
  std::map<std::int64_t, ack_v1> acks_;
  std::optional<timing_v1> timing_;
};

}  // namespace strainwave::testing
