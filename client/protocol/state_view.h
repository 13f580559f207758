// SPDX-License-Identifier: BSD-3-Clause
// The latest state of every joint that is heard, under any prefix. Not real-time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/protocol/latest_messages.h"

namespace strainwave {

/// What was heard of one joint.
struct JointView {
  using Message = state_v1;
  state_v1 state{};
  Instant received;                   ///< by our own clock
  std::int64_t messages = 0;          ///< received so far
  std::int64_t previous_session = 0;  ///< session before the last change, 0: no change yet
  bool two_daemons = false;           ///< an earlier session came back: two daemons use the same channels
  std::int64_t fault_challenge = -1;  ///< of the state that showed its last fault first, -1: none did

  void take(const state_v1& latest);
};

/// "no state for 3.2 s" where none came for half a second, or for `timeout_s` if that is less; else empty.
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

  /// The joint, or null when nothing was heard of it. Lasts until the next message, for ever if the joint is kept.
  const JointView* find(const std::string& prefix, const std::string& joint) const {
    return latest_.find(prefix, joint);
  }

  /// Names of the joints heard under `prefix`, and all prefixes heard; in order.
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
