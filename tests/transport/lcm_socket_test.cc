// SPDX-License-Identifier: BSD-3-Clause
// Our receiver with LCM's own library as the sender, and the datagrams that its socket rejects. Runs in a private network.
#include "transport/lcm_socket.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <lcm/lcm-cpp.hpp>
#include <optional>
#include <string>

#include "tests/support/lcm_datagrams.h"
#include "tests/support/own_port.h"

namespace strainwave {
namespace {

using testing::Bytes;
using testing::own_port;
using testing::own_url;
using testing::pattern;

constexpr std::size_t kAnyDatagram = 65535;

class LcmReceiver {
 public:
  LcmReceiver(std::size_t largest_message, std::size_t largest_datagram)
      : socket_(*parse_udpm_url(own_url()), largest_datagram), reassembly_(largest_message) {}

  /// The next message on `channel`, or nothing when no more datagrams come.
  std::optional<Bytes> next(const std::string& channel) {
    std::optional<Bytes> found;
    pollfd descriptor{socket_.descriptor(), POLLIN, 0};
    while (!found && ::poll(&descriptor, 1, 300) == 1)
      socket_.receive([&](const LcmSource& from, std::span<const std::uint8_t> datagram) {
        const auto message = reassembly_.take(from, datagram);
        if (message && message->channel == channel)
          found.emplace(message->bytes.begin(), message->bytes.end());
      });
    return found;
  }
  const LcmReassembly::Counts& counts() const { return reassembly_.counts(); }

 private:
  LcmSocket socket_;
  LcmReassembly reassembly_;
};

/// Sends a datagram to the port of this test on `host`.
void send_to(const char* host, const Bytes& datagram) {
  const int sender = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(own_port());
  ::inet_pton(AF_INET, host, &address.sin_addr);
  EXPECT_EQ(::sendto(sender, datagram.data(), datagram.size(), 0,
                     static_cast<const sockaddr*>(static_cast<const void*>(&address)), sizeof address),
            static_cast<ssize_t>(datagram.size()));
  ::close(sender);
}

// LCM sends a message that fits in one datagram as a short message, and longer ones in fragments of 65487 bytes.
TEST(LcmSocket, UnderstandsWhatLcmsLibrarySendsFrom0BytesTo300kB) {
  LcmReceiver receiver(300'000, kAnyDatagram);
  lcm::LCM sender(own_url());
  ASSERT_TRUE(sender.good());
  for (const std::size_t size : {0U, 1U, 148U, 8120U, 65'000U, 65'490U, 65'491U, 65'492U, 65'500U, 130'000U,
                                 131'000U, 200'000U, 300'000U}) {
    const Bytes sent = pattern(size, static_cast<std::uint32_t>(size));
    ASSERT_EQ(sender.publish("SW.elbow.TABLE", sent.data(), static_cast<unsigned int>(sent.size())), 0);
    const auto received = receiver.next("SW.elbow.TABLE");
    ASSERT_TRUE(received.has_value()) << size;
    EXPECT_EQ(*received, sent) << size;
  }
  EXPECT_EQ(receiver.counts().malformed + receiver.counts().too_long + receiver.counts().interrupted, 0U);
}

TEST(LcmSocket, DropsAndCountsWhatIsLongerThanTheLargestMessage) {
  LcmReceiver receiver(8120, kAnyDatagram);
  lcm::LCM sender(own_url());
  for (const std::size_t size : {8121U, 65'000U, 100'000U, 300'000U}) {
    const Bytes sent = pattern(size);
    sender.publish("SW.elbow.TABLE", sent.data(), static_cast<unsigned int>(sent.size()));
  }
  const Bytes sound = pattern(8120);
  sender.publish("SW.elbow.TABLE", sound.data(), static_cast<unsigned int>(sound.size()));
  EXPECT_EQ(receiver.next("SW.elbow.TABLE"), sound);
  EXPECT_EQ(receiver.counts().too_long, 1U + 1U + 2U + 5U) << "one for each datagram";
}

TEST(LcmSocket, LetsTheKernelDropWhatIsLongerThanTheLargestDatagram) {
  LcmReceiver receiver(8120, 8204);
  for (int i = 0; i < 100; ++i)
    send_to("239.255.76.67", testing::short_datagram("SW.elbow.TABLE", pattern(60'000)));
  send_to("239.255.76.67", testing::short_datagram("SW.elbow.TABLE", pattern(8120)));
  EXPECT_EQ(receiver.next("SW.elbow.TABLE"), pattern(8120));
  EXPECT_EQ(receiver.counts().too_long, 0U) << "they took room in the queue";
}

TEST(LcmSocket, HearsItsGroupAndNothingThatIsSentToThisMachineItself) {
  LcmReceiver receiver(8120, 8204);
  const Bytes datagram = testing::short_datagram("SW.elbow.COMMAND", pattern(20));
  send_to("127.0.0.1", datagram);
  send_to("127.0.0.2", datagram);
  EXPECT_FALSE(receiver.next("SW.elbow.COMMAND").has_value());
  send_to("239.255.76.67", datagram);
  EXPECT_TRUE(receiver.next("SW.elbow.COMMAND").has_value());
}

TEST(LcmSocket, SharesItsPortWithOtherProgramsOfThisMachine) {
  LcmReceiver first(8120, 8204);
  LcmReceiver second(8120, 8204);
  send_to("239.255.76.67", testing::short_datagram("SW.elbow.COMMAND", pattern(20)));
  EXPECT_TRUE(first.next("SW.elbow.COMMAND").has_value());
  EXPECT_TRUE(second.next("SW.elbow.COMMAND").has_value());
}

}  // namespace
}  // namespace strainwave
