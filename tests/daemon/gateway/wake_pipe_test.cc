// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/gateway/wake_pipe.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>

namespace strainwave {
namespace {

bool readable(const WakePipe& pipe) {
  pollfd descriptor{pipe.core_end(), POLLIN, 0};
  return ::poll(&descriptor, 1, 0) == 1;
}

TEST(WakePipe, IsReadableFromAWakeUntilItIsTaken) {
  WakePipe pipe;
  EXPECT_FALSE(readable(pipe));
  ASSERT_EQ(::write(pipe.gateway_end(), "x", 1), 1);
  EXPECT_TRUE(readable(pipe));
  pipe.take();
  EXPECT_FALSE(readable(pipe));
}

// This hung the supervisor when both ends shared one eventfd. A test that hangs here fails by its time limit.
TEST(WakePipe, NeverWaitsWhateverTheOtherEndDoesToItself) {
  WakePipe pipe;
  ASSERT_EQ(::fcntl(pipe.gateway_end(), F_SETFL, 0), 0);
  EXPECT_NE(::fcntl(pipe.core_end(), F_GETFL) & O_NONBLOCK, 0);
  pipe.take();
}

TEST(WakePipe, TakesABoundedShareOfAFloodOfWakes) {
  WakePipe pipe;
  const std::array<char, 4096> flood{};
  while (::write(pipe.gateway_end(), flood.data(), flood.size()) > 0) {
  }
  pipe.take();
  EXPECT_TRUE(readable(pipe)) << "one read was to be enough: a writer could keep its reader for ever";
}

}  // namespace
}  // namespace strainwave
