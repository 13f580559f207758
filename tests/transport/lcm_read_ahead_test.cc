// SPDX-License-Identifier: BSD-3-Clause
// Reads datagrams ahead while the owner is busy. Runs in a private network.
#include "transport/lcm_read_ahead.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "tests/support/lcm_datagrams.h"
#include "tests/support/multicast_sender.h"
#include "tests/support/own_port.h"

namespace strainwave {
namespace {

using testing::Bytes;
using testing::MulticastSender;
using testing::own_port;
using testing::own_url;
using testing::pattern;

constexpr std::size_t kLargestDatagram = 1000;
constexpr int kSmallQueueBytes = 20'000;

bool is_readable(int descriptor, int timeout_ms) {
  pollfd readable{descriptor, POLLIN, 0};
  return ::poll(&readable, 1, timeout_ms) == 1;
}

/// Waits until the socket's queue is empty.
void wait_until_read(const LcmSocket& socket) {
  constexpr int kPatience_ms = 10'000;
  int waiting = 0;
  for (int waited_ms = 0; waited_ms < kPatience_ms; ++waited_ms) {
    ASSERT_EQ(::ioctl(socket.descriptor(), FIONREAD, &waiting), 0);
    if (waiting == 0) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  FAIL() << "nobody reads";
}

class ReadAhead : public ::testing::Test {
 protected:
  std::vector<Bytes> taken(LcmReadAhead& ahead) {
    std::vector<Bytes> datagrams;
    while (ahead.receive(
               [&](const LcmSource& from, std::int64_t received_us, std::span<const std::uint8_t> datagram) {
                 EXPECT_EQ(from.address, 0x7f000001U);
                 EXPECT_GE(received_us, latest_us_);
                 latest_us_ = received_us;
                 datagrams.emplace_back(datagram.begin(), datagram.end());
               }) > 0) {
    }
    return datagrams;
  }

  LcmSocket socket_{*parse_udpm_url(own_url()), kLargestDatagram, kSmallQueueBytes};
  MulticastSender sender_{own_port()};
  std::int64_t latest_us_ = 1;
};

TEST_F(ReadAhead, KeepsInOrderWhatTheSystemsQueueHasNoRoomForWhileItsOwnerIsBusy) {
  LcmReadAhead ahead(socket_, 4 << 20);
  std::vector<Bytes> sent;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    sent.push_back(pattern(700, i));
    sender_.send(sent.back());
    if (i % 5 == 0) wait_until_read(socket_);
  }
  wait_until_read(socket_);
  EXPECT_EQ(taken(ahead), sent);
  EXPECT_EQ(ahead.dropped(), 0U);
}

TEST_F(ReadAhead, DropsAndCountsWhatFindsNoRoom) {
  LcmReadAhead ahead(socket_, 10'000);
  for (std::uint32_t i = 0; i < 100; ++i) {
    sender_.send(pattern(700, i));
    wait_until_read(socket_);
  }
  const std::size_t kept = taken(ahead).size();
  EXPECT_GT(kept, 5U);
  EXPECT_GT(ahead.dropped(), 50U);
  EXPECT_EQ(kept + ahead.dropped(), 100U);
  sender_.send(pattern(700));
  ASSERT_TRUE(is_readable(ahead.descriptor(), 2000)) << "there is room again";
  EXPECT_EQ(taken(ahead).size(), 1U);
}

TEST_F(ReadAhead, IsReadableAsLongAsSomethingWaits) {
  LcmReadAhead ahead(socket_, 4 << 20);
  EXPECT_FALSE(is_readable(ahead.descriptor(), 50));
  sender_.send(pattern(100));
  ASSERT_TRUE(is_readable(ahead.descriptor(), 2000));
  EXPECT_EQ(taken(ahead).size(), 1U);
  EXPECT_FALSE(is_readable(ahead.descriptor(), 50));
}

TEST(LcmSocketQueue, IsAsLongAsTheSystemAllows) {
  const auto address = *parse_udpm_url(own_url());
  EXPECT_EQ(LcmSocket(address, kLargestDatagram, kSmallQueueBytes).queue_bytes(), kSmallQueueBytes);
}

}  // namespace
}  // namespace strainwave
