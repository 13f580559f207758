// SPDX-License-Identifier: BSD-3-Clause
// Hostile orders mixed with good ones. None may be accepted, and each is counted under its cause.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "daemon/admission/admission.h"
#include "lcmtypes/wire.h"
#include "tests/support/wire_message.h"

namespace strainwave {
namespace {

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;
constexpr int kHostileOrders = 20'000;
constexpr const char* kSetpoint = "SW.elbow.SETPOINT";
constexpr const char* kCommand = "SW.elbow.COMMAND";

/// The defect of a hostile order.
enum class Attack {
  kUnsigned,
  kForged,
  kStranger,
  kReplayed,
  kReordered,
  kOtherSession,
  kStale,
  kOutOfRange,
  kNotFinite,
  kCount
};

class HostileOrders : public ::testing::Test {
 protected:
  HostileOrders()
      : key_(SecretKey::generate()),
        stranger_(SecretKey::generate()),
        admission_("SW", kSession, {{"elbow", {}, -1.0, 1.0, 34.0}},
                   {AuthorizedKeys({{key_.public_key(), Role::kOperator, "Otto"}}), false}) {
    admission_.advance(0, kChallenge);
  }

  setpoint_v1 next_setpoint() {
    setpoint_v1 message{};
    message.session_id = kSession;
    message.challenge = kChallenge;
    message.sender_id = 1;
    message.sequence = sequence_ += 2;
    message.position_rad = std::uniform_real_distribution<>(-1.0, 1.0)(random_);
    return message;
  }
  // Two milliseconds apart: the limit of wasted verifications has its own test.
  Verdict consider(const WireMessage& message) { return admission_.consider(message, now_ns_ += 2'000'000); }

  /// The message of the attack, and the cause under which it must be counted.
  std::pair<WireMessage, Reason> make(Attack attack) {
    setpoint_v1 message = next_setpoint();
    switch (attack) {
      case Attack::kUnsigned:
        return {wire(kSetpoint, message, nullptr), Reason::kUnsigned};
      case Attack::kForged:
        return {forged(message), Reason::kBadSignature};
      case Attack::kStranger:
        return {wire(kSetpoint, message, &stranger_), Reason::kBadSignature};
      case Attack::kReplayed:
        return {last_good_, Reason::kOldSequence};
      case Attack::kReordered:
        message.sequence = last_good_sequence_ - 1;
        return {wire(kSetpoint, message, &key_), Reason::kOldSequence};
      case Attack::kOtherSession:
        message.session_id = static_cast<std::int64_t>(random_() >> 1);
        return {wire(kSetpoint, message, &key_), Reason::kWrongSession};
      case Attack::kStale:
        message.challenge = static_cast<std::int64_t>(random_() >> 1);
        return {wire(kSetpoint, message, &key_), Reason::kTooOld};
      case Attack::kOutOfRange:
        message.position_rad =
            (random_() % 2 == 0 ? 1.0 : -1.0) * std::uniform_real_distribution<>(1.001, 1e9)(random_);
        return {wire(kSetpoint, message, &key_), Reason::kOutOfRange};
      case Attack::kNotFinite:
        message.valid_for_s = random_() % 2 == 0 ? std::nan("") : std::numeric_limits<double>::infinity();
        return {wire(kSetpoint, message, &key_), Reason::kNotFinite};
      case Attack::kCount:
        break;
    }
    return {};
  }
  WireMessage forged(const setpoint_v1& message) {
    WireMessage result = wire(kSetpoint, message, &key_);
    // After the fingerprint, the session and the challenge, which are checked earlier, but not in the key's id.
    const std::size_t key_id = result.size - kSealBytes;
    std::size_t at = 32 + random_() % (result.size - 32);
    if (at >= key_id && at < key_id + sizeof(KeyId)) at += sizeof(KeyId);
    result.bytes[at] = static_cast<std::uint8_t>(result.bytes[at] ^ (1U << random_() % 8));
    return result;
  }
  /// A good order in between. It must be obeyed whatever came before.
  void send_good_order() {
    const setpoint_v1 message = next_setpoint();
    last_good_ = wire(kSetpoint, message, &key_);
    last_good_sequence_ = message.sequence;
    ASSERT_EQ(consider(last_good_).kind, Verdict::Kind::kOrder);
  }

  SecretKey key_;
  SecretKey stranger_;
  Admission admission_;
  std::mt19937_64 random_{20260101};
  std::int64_t sequence_ = 0;
  std::int64_t now_ns_ = 0;
  WireMessage last_good_;
  std::int64_t last_good_sequence_ = 0;
};

TEST_F(HostileOrders, AreNeverObeyedAndEachIsCountedUnderItsCause) {
  std::array<std::int64_t, kReasonCount> expected{};
  for (int i = 0; i < kHostileOrders; ++i) {
    if (i % 100 == 0) send_good_order();
    const auto attack = static_cast<Attack>(random_() % static_cast<std::uint64_t>(Attack::kCount));
    // It is a replay of the last good order only if no newer order was accepted.
    if (attack == Attack::kReplayed || attack == Attack::kReordered) send_good_order();
    const auto [message, cause] = make(attack);
    const Verdict verdict = consider(message);
    ASSERT_NE(verdict.kind, Verdict::Kind::kOrder)
        << "attack " << static_cast<int>(attack) << ", order " << i;
    EXPECT_EQ(verdict.reason, cause) << "attack " << static_cast<int>(attack) << ", order " << i;
    ++expected[static_cast<std::size_t>(cause)];
  }
  EXPECT_EQ(admission_.rejects(), expected);
}

TEST_F(HostileOrders, OfRandomBytesOnEveryChannelAreNeverObeyed) {
  const std::array<const char*, 6> channels{kSetpoint,      kCommand,         "SW.elbow.TABLE",
                                            "SW..SETPOINT", "SW.elbow.STATE", ""};
  const WireMessage sound = wire(kCommand, command_v1{}, nullptr);
  std::int64_t count = 0;
  for (int i = 0; i < kHostileOrders; ++i) {
    WireMessage message;
    message.channel = FixedString<64>(channels[random_() % channels.size()]);
    message.size = i % 10 == 0 ? random_() : random_() % (WireMessage::kMaxBytes + 100);
    for (std::size_t at = 0; at < 256; at += 8) {
      const std::uint64_t bits = random_();
      std::copy_n(reinterpret_cast<const std::uint8_t*>(&bits), 8,
                  message.bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
    // Half of the messages have the right fingerprint and size, so that they pass the first checks. None has the action that stops.
    if (i % 2 == 0) {
      message.channel = FixedString<64>(kCommand);
      message.size = sound.size;
      std::copy_n(sound.bytes.begin(), 8, message.bytes.begin());
    }
    ASSERT_NE(consider(message).kind, Verdict::Kind::kOrder);
    ++count;
  }
  std::int64_t total = 0;
  for (const std::int64_t rejects : admission_.rejects()) total += rejects;
  EXPECT_EQ(total, count);
}

}  // namespace
}  // namespace strainwave
