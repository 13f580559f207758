// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_interface.h"

#include <gtest/gtest.h>
#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>

#include <cstring>
#include <vector>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(const void* data, std::size_t size) {
  Bytes bytes(size);
  std::memcpy(bytes.data(), data, size);
  return bytes;
}

/// One netlink attribute with its padding.
Bytes attribute(std::uint16_t type, const Bytes& value) {
  const rtattr header{static_cast<std::uint16_t>(RTA_LENGTH(value.size())), type};
  Bytes bytes = bytes_of(&header, sizeof header);
  bytes.insert(bytes.end(), value.begin(), value.end());
  bytes.resize(RTA_ALIGN(bytes.size()));
  return bytes;
}

Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

Bytes link_of_a_controller(std::uint32_t bit_rate, std::uint32_t restart_ms) {
  can_bittiming timing{};
  timing.bitrate = bit_rate;
  const Bytes data = attribute(IFLA_CAN_BITTIMING, bytes_of(&timing, sizeof timing)) +
                     attribute(IFLA_CAN_RESTART_MS, bytes_of(&restart_ms, sizeof restart_ms));
  const Bytes info = attribute(IFLA_INFO_KIND, bytes_of("can", 4)) + attribute(IFLA_INFO_DATA, data);
  return attribute(IFLA_IFNAME, bytes_of("can0", 5)) + attribute(IFLA_LINKINFO, info);
}

CanInterface sound_interface() {
  CanInterface interface;
  interface.exists = interface.is_can = interface.up = true;
  interface.kind = "can";
  interface.bit_rate = 1'000'000;
  interface.restart_ms = 0;
  interface.transmit_queue_frames = 10;
  return interface;
}

std::string refusal(const CanInterface& interface) {
  return testing::refusal_of([&] { (void)require_can_interface("can0", interface, 1'000'000, 8); });
}

TEST(CanInterface, ReadsBitRateAndRestartFromTheKernelsAnswer) {
  CanInterface interface;
  read_link_attributes(link_of_a_controller(500'000, 100), interface);
  EXPECT_EQ(interface.kind, "can");
  EXPECT_EQ(interface.bit_rate, 500'000U);
  EXPECT_EQ(interface.restart_ms, 100U);
}

TEST(CanInterface, SurvivesAnAnswerThatIsCutAnywhere) {
  const Bytes whole = link_of_a_controller(500'000, 100);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    CanInterface interface;
    read_link_attributes(std::span(whole).first(size), interface);
    EXPECT_FALSE(interface.restart_ms.has_value()) << size;
  }
}

TEST(CanInterface, SurvivesLengthsThatLie) {
  for (const std::uint16_t length : std::initializer_list<std::uint16_t>{0, 1, 3, 5, 4000, 65535}) {
    const rtattr header{length, IFLA_LINKINFO};
    CanInterface interface;
    read_link_attributes(bytes_of(&header, sizeof header), interface);
    EXPECT_TRUE(interface.kind.empty());
  }
}

TEST(CanInterface, IsAcceptedWhenItIsUpAtTheRightRateWithRoomForAPeriod) {
  EXPECT_EQ(refusal(sound_interface()), "accepted");
}

TEST(CanInterface, RefusalNamesTheCommandThatMendsIt) {
  CanInterface interface = sound_interface();
  interface.up = false;
  EXPECT_NE(refusal(interface).find("ip link set can0 up"), std::string::npos) << refusal(interface);
  interface = sound_interface();
  interface.bit_rate = 500'000;
  EXPECT_NE(refusal(interface).find("500000"), std::string::npos);
  EXPECT_NE(refusal(interface).find("bitrate 1000000"), std::string::npos);
  interface = sound_interface();
  interface.restart_ms = 100;
  EXPECT_NE(refusal(interface).find("restart-ms 0"), std::string::npos);
  interface = sound_interface();
  interface.transmit_queue_frames = 7;
  EXPECT_NE(refusal(interface).find("txqueuelen 8"), std::string::npos);
}

TEST(CanInterface, WithinHalfAPerCentOfTheBitRateIsAcceptedWithALine) {
  CanInterface interface = sound_interface();
  EXPECT_TRUE(require_can_interface("can0", interface, 1'000'000, 8).empty());
  interface.bit_rate = 1'004'016;
  const std::vector<std::string> lines = require_can_interface("can0", interface, 1'000'000, 8);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NE(lines[0].find("1004016 bit/s"), std::string::npos) << lines[0];
  interface.bit_rate = 1'006'000;
  EXPECT_NE(refusal(interface).find("1006000"), std::string::npos);
  interface.bit_rate = 994'000;
  EXPECT_NE(refusal(interface).find("994000"), std::string::npos);
}

TEST(CanInterface, NeedsNoQueueWhereFramesAreHandedOverAtOnce) {
  CanInterface interface = sound_interface();
  interface.kind = "vcan";
  interface.bit_rate.reset();
  interface.restart_ms.reset();
  interface.transmit_queue_frames = 0;
  EXPECT_EQ(refusal(interface), "accepted");
}

TEST(CanInterface, ThatIsAbsentOrOfAnotherKindIsRefused) {
  EXPECT_NE(refusal(inspect_can_interface("no-such-link")).find("no such interface"), std::string::npos);
  EXPECT_NE(refusal(inspect_can_interface("lo")).find("not a CAN interface"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
