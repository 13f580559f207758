// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_reassembly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/support/allocation_trap.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave {
namespace {

using testing::Bytes;
using testing::fragment_datagram;
using testing::FragmentHeader;
using testing::fragments;
using testing::pattern;
using testing::short_datagram;

constexpr std::size_t kLargest = 8120;
constexpr std::uint32_t kThisMachine = 0x7f000001;
constexpr LcmSource kSender{0xc0a80705, 40001};
constexpr const char* kChannel = "SW.elbow.TABLE";

struct Delivered {
  std::string channel;
  Bytes bytes;
  bool operator==(const Delivered&) const = default;
};

class Receiver {
 public:
  explicit Receiver(std::size_t largest = kLargest) : reassembly_(largest) {}
  void take(const LcmSource& from, const Bytes& datagram) {
    const auto message = reassembly_.take(from, datagram);
    if (message)
      delivered_.push_back({std::string(message->channel), {message->bytes.begin(), message->bytes.end()}});
  }
  void take_all(const LcmSource& from, const std::vector<Bytes>& datagrams) {
    for (const Bytes& datagram : datagrams) take(from, datagram);
  }
  const std::vector<Delivered>& delivered() const { return delivered_; }
  const LcmReassembly::Counts& counts() const { return reassembly_.counts(); }

 private:
  LcmReassembly reassembly_;
  std::vector<Delivered> delivered_;
};

TEST(LcmReassembly, DeliversMessagesOfEverySizeWholeAndInPieces) {
  for (const std::size_t size : {0U, 1U, 1422U, 1423U, 1424U, 2846U, 8119U, 8120U}) {
    Receiver receiver;
    receiver.take(kSender, short_datagram(kChannel, pattern(size)));
    if (size > 0) receiver.take_all(kSender, fragments(kChannel, pattern(size), 1423));
    ASSERT_EQ(receiver.delivered().size(), size > 0 ? 2U : 1U) << size;
    for (const Delivered& message : receiver.delivered())
      EXPECT_EQ(message, (Delivered{kChannel, pattern(size)}));
  }
}

TEST(LcmReassembly, DropsAndCountsWhatIsLongerThanTheLargest) {
  Receiver receiver;
  receiver.take(kSender, short_datagram(kChannel, pattern(kLargest + 1)));
  receiver.take_all(kSender, fragments(kChannel, pattern(kLargest + 1), 5000));
  receiver.take(kSender, fragment_datagram({1, UINT32_MAX, 0, 1, 2}, pattern(100)));
  EXPECT_TRUE(receiver.delivered().empty());
  EXPECT_EQ(receiver.counts().too_long, 4U);
}

TEST(LcmReassembly, DeliversOnceWhateverTheOrderAndHoweverOftenFragmentsCome) {
  std::mt19937 random(20261121);
  const std::vector<Bytes> sound = fragments(kChannel, pattern(8000), 1000);
  for (int run = 0; run < 50; ++run) {
    std::vector<Bytes> datagrams = sound;
    datagrams.insert(datagrams.end(), sound.begin(), sound.begin() + run % 8);
    std::shuffle(datagrams.begin(), datagrams.end(), random);
    Receiver receiver;
    receiver.take_all(kSender, datagrams);
    ASSERT_EQ(receiver.delivered().size(), 1U) << run;
    EXPECT_EQ(receiver.delivered()[0], (Delivered{kChannel, pattern(8000)}));
  }
}

TEST(LcmReassembly, DeliversNothingWhileAFragmentIsMissing) {
  const std::vector<Bytes> sound = fragments(kChannel, pattern(8000), 1000);
  for (std::size_t missing = 0; missing < sound.size(); ++missing) {
    Receiver receiver;
    for (std::size_t i = 0; i < sound.size(); ++i)
      if (i != missing) receiver.take(kSender, sound[i]);
    EXPECT_TRUE(receiver.delivered().empty());
    receiver.take(kSender, short_datagram(kChannel, pattern(3)));
    receiver.take_all(kSender, fragments(kChannel, pattern(5000, 2), 1000, 9));
    EXPECT_EQ(receiver.delivered().size(), 2U) << "the source was not forgiven";
    EXPECT_EQ(receiver.counts().interrupted, 1U);
  }
}

TEST(LcmReassembly, RefusesFragmentsThatOverlapOrLeaveAGap) {
  const auto offer = [](std::uint32_t second_offset, std::size_t second_bytes) {
    Receiver receiver;
    Bytes first;
    testing::put_channel(first, kChannel);
    first.resize(first.size() + 100);
    receiver.take(kSender, fragment_datagram({1, 200, 0, 0, 2}, first));
    receiver.take(kSender, fragment_datagram({1, 200, second_offset, 1, 2}, pattern(second_bytes)));
    return receiver;
  };
  EXPECT_EQ(offer(100, 100).delivered().size(), 1U);
  for (const auto& [offset, bytes] : std::vector<std::pair<std::uint32_t, std::size_t>>{
           {99, 100}, {99, 101}, {101, 99}, {100, 99}, {0, 200}, {0, 0}}) {
    const Receiver receiver = offer(offset, bytes);
    EXPECT_TRUE(receiver.delivered().empty()) << offset;
    EXPECT_EQ(receiver.counts().malformed, 1U);
  }
}

TEST(LcmReassembly, KeepsSourcesApartThatSendTheSameSequence) {
  Receiver receiver;
  std::vector<std::vector<Bytes>> of;
  for (std::uint32_t i = 0; i < 20; ++i) of.push_back(fragments(kChannel, pattern(3000, i), 500, 7));
  for (std::size_t part = 0; part < 6; ++part)
    for (std::uint32_t i = 0; i < 20; ++i)
      receiver.take({0xc0a80700 + i / 4, static_cast<std::uint16_t>(i % 4)}, of[i][part]);
  ASSERT_EQ(receiver.delivered().size(), 20U);
  for (std::uint32_t i = 0; i < 20; ++i) EXPECT_EQ(receiver.delivered()[i].bytes, pattern(3000, i));
}

TEST(LcmReassembly, LetsNoHostPushOutTheMessageOfAnother) {
  Receiver receiver;
  const std::vector<Bytes> sound = fragments(kChannel, pattern(8000), 1000);
  for (const Bytes& fragment : sound) {
    receiver.take(kSender, fragment);
    // Many ports and addresses of this machine.
    for (std::uint32_t i = 0; i < 5000; ++i)
      receiver.take({kThisMachine + i * 13, static_cast<std::uint16_t>(i)},
                    fragment_datagram({i, 2000, 1000, 1, 2}, pattern(10)));
  }
  ASSERT_EQ(receiver.delivered().size(), 1U);
  EXPECT_EQ(receiver.delivered()[0].bytes, pattern(8000));
  EXPECT_GT(receiver.counts().interrupted, 30'000U);
}

TEST(LcmReassembly, SurvivesTheFragmentThatCrashesLcmsLibrary) {
  Receiver receiver;
  for (std::uint32_t i = 0; i < 1000; ++i)
    receiver.take_all(kSender, testing::crashing_fragments(kChannel, i));
  EXPECT_TRUE(receiver.delivered().empty());
  EXPECT_EQ(receiver.counts().malformed, 1000U);
}

TEST(LcmReassembly, AllocatesNothingAfterItsStart) {
  if (!AllocationTrap::available()) GTEST_SKIP() << "a sanitizer has its own allocator";
  LcmReassembly reassembly(kLargest);
  std::vector<std::vector<Bytes>> datagrams;
  for (std::uint32_t i = 0; i < 100; ++i) datagrams.push_back(fragments(kChannel, pattern(8000, i), 1000, i));
  std::size_t delivered = 0;
  const AllocationTrap trap;
  for (std::uint32_t i = 0; i < 100; ++i)
    for (const Bytes& datagram : datagrams[i])
      delivered += reassembly.take({kThisMachine, static_cast<std::uint16_t>(i)}, datagram) ? 1U : 0U;
  EXPECT_EQ(trap.touches(), 0);
  EXPECT_EQ(delivered, 100U);
}

}  // namespace
}  // namespace strainwave
