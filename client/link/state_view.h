// The latest state of every joint that is heard, under any prefix. Bytes from the network are hostile:
// messages of another size or type, and channels that are none of ours, are ignored. Not real-time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <strainwave/state_v1.hpp>
#include <string>
#include <utility>
#include <vector>

#include "client/link/clock.h"
#include "client/link/connection.h"

namespace strainwave {

struct JointView {
  state_v1 state{};
  Instant received;                   ///< by our own clock
  std::int64_t messages = 0;          ///< received so far
  std::int64_t previous_session = 0;  ///< session before the last change, 0: no change yet
  bool two_daemons = false;           ///< an earlier session came back: two daemons use the same channels
};

class StateView {
 public:
  /// More joints than any network of ours has; whoever sends more names is not a daemon.
  static constexpr std::size_t kMaxJoints = 1024;

  /// Starts to listen.
  explicit StateView(Connection& connection);

  /// The joint, or null when nothing was heard of it.
  const JointView* find(const std::string& prefix, const std::string& joint) const;

  /// Names of the joints heard under `prefix`, and all prefixes heard; in order.
  std::vector<std::string> joints(const std::string& prefix) const;
  std::vector<std::string> prefixes() const;

  /// Takes one message, as the subscription does.
  void accept(const std::string& channel, std::span<const std::uint8_t> bytes);

 private:
  void on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel);

  std::map<std::pair<std::string, std::string>, JointView> joints_;
  Subscription subscription_;
};

}  // namespace strainwave
