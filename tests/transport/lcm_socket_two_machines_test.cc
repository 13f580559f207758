// SPDX-License-Identifier: BSD-3-Clause
// The senders that a socket hears over a cable: two private networks with a virtual cable. Each test enters new ones.
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <arpa/inet.h>

#include <cstdlib>
#include <string>

#include "tests/support/lcm_datagrams.h"
#include "tests/support/private_network.h"
#include "transport/lcm_socket.h"

namespace strainwave {
namespace {

constexpr const char* kGroup = "239.255.76.67";

bool run(const std::string& command) {
  const std::string with_path = "PATH=$PATH:/usr/sbin:/sbin; " + command;
  return std::system(with_path.c_str()) == 0;  // NOLINT(concurrency-mt-unsafe): one thread
}

/// Sends one datagram with a TTL of 1 to the group, from the interface with `interface_address`.
void send_from(const char* interface_address) {
  const int sender = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  in_addr out{};
  ::inet_pton(AF_INET, interface_address, &out);
  const int hops = 1;
  ::setsockopt(sender, IPPROTO_IP, IP_MULTICAST_IF, &out, sizeof out);
  ::setsockopt(sender, IPPROTO_IP, IP_MULTICAST_TTL, &hops, sizeof hops);
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(7667);
  ::inet_pton(AF_INET, kGroup, &group.sin_addr);
  const testing::Bytes datagram = testing::short_datagram("SW.elbow.COMMAND", testing::pattern(20));
  ::sendto(sender, datagram.data(), datagram.size(), 0,
           static_cast<const sockaddr*>(static_cast<const void*>(&group)), sizeof group);
  ::close(sender);
}

int heard(LcmSocket& socket) {
  int count = 0;
  pollfd descriptor{socket.descriptor(), POLLIN, 0};
  while (::poll(&descriptor, 1, 300) == 1)
    socket.receive([&](const LcmSource&, std::span<const std::uint8_t>) { ++count; });
  return count;
}

/// This machine, 10.9.0.1, and another one, 10.9.0.2, that sends on request.
class TwoMachines : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!testing::enter_private_network(false)) GTEST_SKIP() << "no network namespaces here";
    ASSERT_EQ(::pipe(tell_), 0);
    ASSERT_EQ(::pipe(told_), 0);
    other_ = ::fork();
    if (other_ == 0) be_the_other();
    wait();
    if (!run("ip link add near type veth peer name far netns " + std::to_string(other_)))
      GTEST_SKIP() << "no virtual cable in this kernel";
    ASSERT_TRUE(run("ip address add 10.9.0.1/24 dev near && ip link set near up"));
    tell();
    wait();
  }
  void TearDown() override {
    if (other_ > 0) {
      ::kill(other_, SIGKILL);
      ::waitpid(other_, nullptr, 0);
    }
  }
  /// The other machine sends one datagram.
  void other_sends() {
    tell();
    wait();
  }
  static void route_over(const std::string& interface) {
    ASSERT_TRUE(run("ip link set lo multicast on && ip route replace " + std::string(kGroup) + "/32 dev " +
                    interface));
  }

 private:
  [[noreturn]] void be_the_other() const {
    ::unshare(CLONE_NEWNET);
    char byte = 0;
    answer();
    if (::read(tell_[0], &byte, 1) != 1) ::_exit(1);
    run("ip address add 10.9.0.2/24 dev far && ip link set far up");
    answer();
    while (::read(tell_[0], &byte, 1) == 1) {
      send_from("10.9.0.2");
      answer();
    }
    ::_exit(0);
  }
  void answer() const {
    if (::write(told_[1], "x", 1) != 1) ::_exit(1);
  }
  void tell() const { ASSERT_EQ(::write(tell_[1], "x", 1), 1); }
  void wait() const {
    char byte = 0;
    ASSERT_EQ(::read(told_[0], &byte, 1), 1);
  }
  int tell_[2] = {-1, -1};
  int told_[2] = {-1, -1};
  pid_t other_ = -1;
};

TEST_F(TwoMachines, AMachineThatIsMeantToHearOthersDoes) {
  route_over("near");
  LcmSocket socket({kGroup, 7667, 1}, 8204);
  other_sends();
  EXPECT_EQ(heard(socket), 1);
  send_from("10.9.0.1");
  EXPECT_EQ(heard(socket), 1);
}

TEST_F(TwoMachines, WithoutHopsOnlyThisMachineIsHeardEvenOnARealInterface) {
  route_over("near");
  LcmSocket socket({kGroup, 7667, 0}, 8204);
  other_sends();
  EXPECT_EQ(heard(socket), 0);
  send_from("10.9.0.1");
  EXPECT_EQ(heard(socket), 1);
}

TEST_F(TwoMachines, AnInterfaceThatTheRouteDoesNotNameIsNotHeard) {
  route_over("lo");
  LcmSocket socket({kGroup, 7667, 1}, 8204);
  // Another program of this machine joins the group on that interface, so that the kernel accepts the datagrams.
  const int neighbour = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  ip_mreq membership{};
  ::inet_pton(AF_INET, kGroup, &membership.imr_multiaddr);
  ::inet_pton(AF_INET, "10.9.0.1", &membership.imr_interface);
  ASSERT_EQ(::setsockopt(neighbour, IPPROTO_IP, IP_ADD_MEMBERSHIP, &membership, sizeof membership), 0);
  other_sends();
  EXPECT_EQ(heard(socket), 0);
  send_from("127.0.0.1");
  EXPECT_EQ(heard(socket), 1);
  ::close(neighbour);
}

}  // namespace
}  // namespace strainwave
