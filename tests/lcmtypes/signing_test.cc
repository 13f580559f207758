// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/signing.h"

#include <gtest/gtest.h>

#include <strainwave/command_v1.hpp>
#include <strainwave/gain_table_v1.hpp>
#include <strainwave/path_v1.hpp>
#include <strainwave/setpoint_v1.hpp>
#include <vector>

#include "lcmtypes/wire.h"

namespace strainwave {
namespace {

constexpr const char* kChannel = "SW.elbow.COMMAND";

SecretKey key_number(std::uint8_t number) {
  SecretKey::Seed seed{};
  seed.fill(number);
  return SecretKey(seed);
}

std::vector<std::uint8_t> signed_command(const SecretKey& key) {
  command_v1 message{};
  message.session_id = 7;
  message.action = 1;
  std::vector<std::uint8_t> bytes = encode(message);
  sign(kChannel, key, bytes);
  return bytes;
}

TEST(Signing, IsBelievedOnlyForTheKeyThatSigned) {
  const std::vector<std::uint8_t> bytes = signed_command(key_number(1));
  EXPECT_TRUE(verify(kChannel, key_number(1).public_key(), bytes));
  EXPECT_FALSE(verify(kChannel, key_number(2).public_key(), bytes));
}

TEST(Signing, CoversEveryBitOfTheMessageAndOfTheSignature) {
  const PublicKey key = key_number(1).public_key();
  std::vector<std::uint8_t> bytes = signed_command(key_number(1));
  const std::size_t key_id_begin = bytes.size() - kSealBytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    // key_id only selects the key for the check. With a changed key_id the other key refuses the message.
    if (i >= key_id_begin && i < key_id_begin + sizeof(KeyId)) continue;
    for (int bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
      EXPECT_FALSE(verify(kChannel, key, bytes)) << "byte " << i << ", bit " << bit;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1U << bit));
    }
  }
  EXPECT_TRUE(verify(kChannel, key, bytes));
}

TEST(Signing, CoversTheChannelSoThatAnOrderForOneJointIsNoneForAnother) {
  const std::vector<std::uint8_t> bytes = signed_command(key_number(1));
  for (const char* other :
       {"SW.wrist.COMMAND", "SW.elbow.SETPOINT", "LAB.elbow.COMMAND", "SW.elbow.COMMAN", ""})
    EXPECT_FALSE(verify(other, key_number(1).public_key(), bytes)) << other;
}

TEST(Signing, LeavesTheFieldsAloneAndNamesItsKey) {
  const SecretKey key = key_number(1);
  const auto read = decode_exactly<command_v1>(signed_command(key));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->session_id, 7);
  EXPECT_EQ(read->action, 1);
  EXPECT_TRUE(std::equal(std::begin(read->key_id), std::end(read->key_id), key.public_key().id().begin()));
}

template <typename Message>
void expect_seal_at_the_end() {
  Message message{};
  std::vector<std::uint8_t> bytes = encode(message);
  EXPECT_TRUE(is_unsigned(bytes));
  sign(kChannel, key_number(3), bytes);
  EXPECT_FALSE(is_unsigned(bytes));
  EXPECT_EQ(key_id_of(bytes), key_number(3).public_key().id());
  const auto read = decode_exactly<Message>(bytes);
  ASSERT_TRUE(read);
  EXPECT_TRUE(std::equal(std::begin(read->signature), std::end(read->signature), bytes.end() - 64));
}

TEST(Signing, FindsKeyAndSignatureAtTheEndOfEveryOrder) {
  expect_seal_at_the_end<setpoint_v1>();
  expect_seal_at_the_end<path_v1>();
  expect_seal_at_the_end<command_v1>();
  expect_seal_at_the_end<gain_table_v1>();
}

TEST(Signing, MakesNothingOfMessagesTooShortForASignature) {
  std::vector<std::uint8_t> bytes(kSealBytes - 1, 1);
  sign(kChannel, key_number(1), bytes);
  EXPECT_EQ(bytes, std::vector<std::uint8_t>(kSealBytes - 1, 1));
  EXPECT_FALSE(verify(kChannel, key_number(1).public_key(), bytes));
  EXPECT_EQ(key_id_of(bytes), KeyId{});
}

TEST(Signing, IsNotFooledByAKeyOfSmallOrder) {
  // The neutral element verifies a forged signature in careless implementations.
  PublicKey neutral{};
  neutral.bytes[0] = 1;
  EXPECT_FALSE(neutral.is_valid());
  std::vector<std::uint8_t> bytes = encode(command_v1{});
  bytes[bytes.size() - 64] = 1;
  EXPECT_FALSE(verify(kChannel, neutral, bytes));
}

// RFC 8032, section 7.1, test 1: the seed and its public key.
TEST(Signing, DerivesThePublicKeyOfTheStandardsExample) {
  const SecretKey::Seed seed{0x9d, 0x61, 0xb1, 0x9d, 0xef, 0xfd, 0x5a, 0x60, 0xba, 0x84, 0x4a,
                             0xf4, 0x92, 0xec, 0x2c, 0xc4, 0x44, 0x49, 0xc5, 0x69, 0x7b, 0x32,
                             0x69, 0x19, 0x70, 0x3b, 0xac, 0x03, 0x1c, 0xae, 0x7f, 0x60};
  const KeyId expected{0xd7, 0x5a, 0x98, 0x01, 0x82, 0xb1, 0x0a, 0xb7};
  EXPECT_EQ(SecretKey(seed).public_key().id(), expected);
  EXPECT_EQ(SecretKey(seed).seed(), seed);
}

TEST(Signing, GeneratesKeysThatDiffer) {
  EXPECT_NE(SecretKey::generate().seed(), SecretKey::generate().seed());
}

}  // namespace
}  // namespace strainwave
