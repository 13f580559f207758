// SPDX-License-Identifier: BSD-3-Clause
// A joint of the library and the fake daemon that receives its streams.
#pragma once

#include <gtest/gtest.h>

#include <vector>

#include "lcmtypes/wire.h"
#include "strainwave/joint.h"
#include "tests/client/protocol/running_daemon.h"

namespace strainwave::testing {

class StreamTest : public ::testing::Test {
 protected:
  /// Silences the daemon and returns the received messages without repetitions.
  template <typename Message>
  std::vector<Message> heard() {
    daemon.stop();
    std::vector<Message> messages;
    for (const FakeDaemon::Heard& order : daemon.daemon().heard()) {
      const auto message = decode_exactly<Message>(order.bytes);
      if (message && (messages.empty() || messages.back().sequence != message->sequence))
        messages.push_back(*message);
    }
    return messages;
  }

  RunningDaemon daemon{own_url()};
  Joint joint{"elbow", {.key = "", .lcm_url = own_url(), .timeout_s = 20.0}};
};

}  // namespace strainwave::testing
