// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/sender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <thread>

#include "base/utime.h"

namespace strainwave {
namespace {

TEST(Sender, SequencesRiseOverAllKindsOfMessages) {
  Sender sender(5);
  std::int64_t last = 0;
  for (int i = 0; i < 10; ++i) {
    for (const std::int64_t sequence :
         {sender.seal("a", setpoint_v1{}, {1, 2}).sequence, sender.seal("b", command_v1{}, {1, 2}).sequence,
          sender.seal("c", gain_table_v1{}, {1, 2}).sequence}) {
      EXPECT_GT(sequence, last);
      last = sequence;
    }
  }
}

TEST(Sender, WritesTheEnvelopeIntoTheMessageAndKeepsItsContent) {
  Sender sender(5);
  setpoint_v1 message{};
  message.position_rad = 0.25;
  const SealedMessage sealed = sender.seal("SW.elbow.SETPOINT", message, {77, 815});
  const auto read = decode_exactly<setpoint_v1>(sealed.bytes);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->session_id, 77);
  EXPECT_EQ(read->challenge, 815);
  EXPECT_EQ(read->sender_id, 5);
  EXPECT_EQ(read->sequence, sealed.sequence);
  EXPECT_EQ(read->position_rad, 0.25);
  EXPECT_GT(read->utime, 0);
  EXPECT_EQ(sealed.channel, "SW.elbow.SETPOINT");
}

TEST(Sender, TellsWhenAMessageIsSent) {
  Sender sender(5);
  std::int64_t before = utime_now();
  for (int i = 0; i < 3; ++i) {
    setpoint_v1 message{};
    message.utime = 17;  // an old time, as in a message from a recording
    const auto read = decode_exactly<setpoint_v1>(sender.seal("SW.elbow.SETPOINT", message, {77, 815}).bytes);
    ASSERT_TRUE(read);
    EXPECT_GE(read->utime, before);
    before = utime_now();
    EXPECT_LE(read->utime, before);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

TEST(Sender, LeavesKeyAndSignatureZeroWhileNothingIsSigned) {
  Sender sender;
  command_v1 message{};
  std::fill(std::begin(message.signature), std::end(message.signature), std::uint8_t{0});
  const auto read = decode_exactly<command_v1>(sender.seal("c", message, {1, 2}).bytes);
  ASSERT_TRUE(read);
  EXPECT_TRUE(
      std::all_of(std::begin(read->key_id), std::end(read->key_id), [](auto byte) { return byte == 0; }));
  EXPECT_TRUE(std::all_of(std::begin(read->signature), std::end(read->signature),
                          [](auto byte) { return byte == 0; }));
}

TEST(Sender, IsTheSameForEveryProgramOfAUserOnOneMachine) {
  EXPECT_EQ(Sender().sender_id(), Sender().sender_id());
  EXPECT_GT(Sender().sender_id(), 0);
}

TEST(Sender, RisesAboveWhatAnotherProgramOfItsKeyHasSent) {
  Sender sender(5);
  const std::int64_t ahead = sender.seal("a", command_v1{}, {1, 2}).sequence + 1'000'000'000;
  sender.rise_above(ahead);
  EXPECT_EQ(sender.seal("a", command_v1{}, {1, 2}).sequence, ahead + 1);
}

TEST(Sender, IsNotTakenToTheEndOfItsNumbersByAForgedAnswer) {
  Sender sender(5);
  sender.rise_above(std::numeric_limits<std::int64_t>::max());
  const std::int64_t first = sender.seal("a", command_v1{}, {1, 2}).sequence;
  EXPECT_GT(first, 0);
  EXPECT_LT(first, Sender::kLargestSequence);
}

}  // namespace
}  // namespace strainwave
