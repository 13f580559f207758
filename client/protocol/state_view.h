// SPDX-License-Identifier: BSD-3-Clause
// The latest state of every joint that is heard, under any prefix. Not real-time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/protocol/latest_messages.h"

namespace strainwave {

/// The received data of one joint.
struct JointView {
  using Message = state_v1;
  state_v1 state{};
  Instant received;                   ///< by this computer's clock
  std::int64_t messages = 0;          ///< number of messages so far
  std::int64_t previous_session = 0;  ///< session before the last change, 0: no change yet
  bool two_daemons = false;           ///< an earlier session came back: two daemons use the same channels
  std::int64_t fault_challenge = -1;  ///< challenge of the first state with its last fault, -1: none

  void take(const state_v1& latest);
};

/// "no state for 3.2 s" after half a second without a state, or after `timeout_s` if that is less; otherwise empty.
std::string silence_of(const JointView& view, double timeout_s);

/// See lcmtypes/cycle_fields.h.
double tracking_error_rad(const JointView& view) noexcept;

class StateView {
 public:
  static constexpr std::size_t kMaxJoints = LatestMessages<JointView>::kMaxNames;

  /// Starts to listen.
  explicit StateView(Connection& connection) : latest_(connection) {}

  /// See LatestMessages.
  void keep(const std::string& prefix, const std::string& joint) { latest_.keep({prefix, joint}); }

  /// The joint, or null if it was not heard. Valid until the next message, or for a kept joint as long as this object.
  const JointView* find(const std::string& prefix, const std::string& joint) const {
    return latest_.find(prefix, joint);
  }

  /// The joints heard under `prefix`, and all prefixes heard; sorted.
  std::vector<std::string> joints(const std::string& prefix) const;
  std::vector<std::string> prefixes() const;

  /// See LatestMessages.
  bool another_version(const std::string& prefix) const { return latest_.another_version(prefix); }

  /// Takes one message, as the subscription does.
  void accept(const std::string& channel, std::span<const std::uint8_t> bytes, const LcmSource& from = {}) {
    latest_.accept(channel, bytes, from);
  }

 private:
  LatestMessages<JointView> latest_;
};

}  // namespace strainwave
