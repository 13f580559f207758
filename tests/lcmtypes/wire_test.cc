// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/wire.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <strainwave/ack_v1.hpp>
#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/inject_v1.hpp>
#include <strainwave/limits_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <strainwave/state_v1.hpp>
#include <strainwave/temperature_v1.hpp>
#include <strainwave/timing_v1.hpp>

#include "lcmtypes/channels.h"
#include "lcmtypes/fingerprints.h"

namespace strainwave {
namespace {

/// LCM's 64-bit type fingerprint leads every message.
constexpr std::size_t kFingerprintBytes = 8;

template <typename Message>
class WireTest : public ::testing::Test {
 protected:
  /// A message of random bytes, which may be NaNs.
  static Message random_message(unsigned seed) {
    static_assert(std::is_trivially_copyable_v<Message>);
    std::mt19937 random(seed);
    std::vector<unsigned char> bytes(sizeof(Message));
    for (auto& byte : bytes) byte = static_cast<unsigned char>(random());
    Message message;
    std::memcpy(&message, bytes.data(), sizeof(Message));
    return message;
  }
};

using Messages = ::testing::Types<ack_v1, command_v1, gain_table_v1, path_v1, setpoint_v1, state_v1,
                                  temperature_v1, timing_v1>;
class MessageNames {
 public:
  template <typename Message>
  static std::string GetName(int) {
    return Message::getTypeName();
  }
};
TYPED_TEST_SUITE(WireTest, Messages, MessageNames);

TYPED_TEST(WireTest, EveryByteSurvivesTheRoundTrip) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const std::vector<std::uint8_t> bytes = encode(this->random_message(seed));
    const auto read = decode_exactly<TypeParam>(bytes);
    ASSERT_TRUE(read);
    EXPECT_EQ(encode(*read), bytes);
  }
}

TYPED_TEST(WireTest, HasOneSizeWhateverItsContent) {
  const std::size_t size = encode(this->random_message(0)).size();
  for (unsigned seed = 1; seed < 20; ++seed) EXPECT_EQ(encode(this->random_message(seed)).size(), size);
}

TYPED_TEST(WireTest, RefusesEveryOtherLength) {
  std::vector<std::uint8_t> bytes = encode(this->random_message(1));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    ASSERT_FALSE(decode_exactly<TypeParam>(std::span(bytes).first(length))) << length;
  }
  for (int more = 0; more < 64; ++more) {
    bytes.push_back(0);
    ASSERT_FALSE(decode_exactly<TypeParam>(bytes));
  }
}

TYPED_TEST(WireTest, RefusesEveryOtherFingerprint) {
  const std::vector<std::uint8_t> good = encode(this->random_message(2));
  for (std::size_t bit = 0; bit < 8 * kFingerprintBytes; ++bit) {
    std::vector<std::uint8_t> bytes = good;
    bytes.at(bit / 8) ^= static_cast<std::uint8_t>(1U << (bit % 8));
    ASSERT_FALSE(decode_exactly<TypeParam>(bytes)) << bit;
  }
}

TYPED_TEST(WireTest, FitsIntoOneDatagram) {
  EXPECT_LT(encode(TypeParam{}).size(), 60'000U);
}

TEST(Wire, NoTypeIsTakenForAnother) {
  const std::vector<std::vector<std::uint8_t>> all{
      encode(ack_v1{}),   encode(command_v1{}), encode(gain_table_v1{}), encode(setpoint_v1{}),
      encode(state_v1{}), encode(timing_v1{}),  encode(temperature_v1{})};
  int taken = 0;
  for (const auto& bytes : all) {
    taken += decode_exactly<ack_v1>(bytes).has_value() + decode_exactly<command_v1>(bytes).has_value() +
             decode_exactly<gain_table_v1>(bytes).has_value() +
             decode_exactly<setpoint_v1>(bytes).has_value() + decode_exactly<state_v1>(bytes).has_value() +
             decode_exactly<timing_v1>(bytes).has_value() + decode_exactly<temperature_v1>(bytes).has_value();
  }
  EXPECT_EQ(taken, static_cast<int>(all.size()));
}

TEST(Wire, IsBigEndianAfterTheFingerprint) {
  command_v1 message{};
  message.utime = 0x0102030405060708;
  const std::vector<std::uint8_t> bytes = encode(message);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(bytes.at(kFingerprintBytes + i), i + 1);
}

TEST(Fingerprint, TellsAnotherVersionFromATornMessageAndFromOurs) {
  std::vector<std::uint8_t> bytes = encode(command_v1{});
  EXPECT_FALSE(is_of_another_version(channel_kind::kCommand, bytes));
  EXPECT_FALSE(is_of_another_version(channel_kind::kCommand, std::span(bytes).first(9))) << "torn";
  EXPECT_FALSE(is_of_another_version(channel_kind::kCommand, std::span(bytes).first(7)));
  EXPECT_FALSE(is_of_another_version("NONE", bytes));
  EXPECT_TRUE(is_of_another_version(channel_kind::kSetpoint, bytes));
  for (std::size_t i = 0; i < kFingerprintBytes; ++i) {
    std::vector<std::uint8_t> other = bytes;
    other[i] ^= 1;
    EXPECT_TRUE(is_of_another_version(channel_kind::kCommand, other)) << i;
  }
}

TEST(Fingerprint, OfEachKindOfChannelIsThatOfItsOwnTypeAlone) {
  const std::vector<std::pair<std::string_view, std::vector<std::uint8_t>>> kinds{
      {channel_kind::kState, encode(state_v1{})},
      {channel_kind::kTemperature, encode(temperature_v1{})},
      {channel_kind::kLimits, encode(limits_v1{})},
      {channel_kind::kTiming, encode(timing_v1{})},
      {channel_kind::kSetpoint, encode(setpoint_v1{})},
      {channel_kind::kCommand, encode(command_v1{})},
      {channel_kind::kInject, encode(inject_v1{})},
      {channel_kind::kAck, encode(ack_v1{})},
      {channel_kind::kPath, encode(path_v1{})},
      {channel_kind::kTable, encode(gain_table_v1{})}};
  for (const auto& [kind, own] : kinds)
    for (const auto& [other, bytes] : kinds)
      EXPECT_EQ(is_of_another_version(kind, bytes), kind != other) << kind << " and " << other;
}

}  // namespace
}  // namespace strainwave
