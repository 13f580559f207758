// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/gain_table_message.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "lcmtypes/wire.h"

namespace strainwave {
namespace {

/// A message with random bytes as its table: NaNs with payloads, impossible counts, unterminated text.
gain_table_v1 random_message(unsigned seed) {
  static_assert(std::is_trivially_copyable_v<gain_table_v1>);
  std::mt19937 random(seed);
  std::vector<unsigned char> bytes(sizeof(gain_table_v1));
  for (auto& byte : bytes) byte = static_cast<unsigned char>(random());
  gain_table_v1 message;
  std::memcpy(&message, bytes.data(), sizeof(message));
  message.utime = message.session_id = message.challenge = message.sender_id = message.sequence = 0;
  std::fill(std::begin(message.key_id), std::end(message.key_id), std::uint8_t{0});
  std::fill(std::begin(message.signature), std::end(message.signature), std::uint8_t{0});
  return message;
}

TEST(GainTableMessage, CarriesTheTableBitForBit) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const gain_table_v1 message = random_message(seed);
    EXPECT_EQ(encode(to_message(to_gain_table(message))), encode(message)) << seed;
  }
}

TEST(GainTableMessage, LosesNoBitOfAnyField) {
  const std::vector<std::uint8_t> good = encode(random_message(4));
  constexpr std::size_t kBeforeTable = 8 + 5 * sizeof(std::int64_t);  // fingerprint, envelope
  constexpr std::size_t kAfterTable = sizeof(gain_table_v1::key_id) + sizeof(gain_table_v1::signature);
  for (std::size_t i = kBeforeTable; i < good.size() - kAfterTable; ++i) {
    std::vector<std::uint8_t> bytes = good;
    bytes[i] ^= 0x10;
    const auto message = decode_exactly<gain_table_v1>(bytes);
    ASSERT_TRUE(message);
    ASSERT_EQ(encode(to_message(to_gain_table(*message))), bytes) << "byte " << i;
  }
}

TEST(GainTableMessage, LeavesTheEnvelopeToTheSender) {
  const gain_table_v1 message = to_message(to_gain_table(random_message(5)));
  EXPECT_EQ(message.utime, 0);
  EXPECT_EQ(message.session_id, 0);
  EXPECT_EQ(message.challenge, 0);
  EXPECT_EQ(message.sender_id, 0);
  EXPECT_EQ(message.sequence, 0);
  EXPECT_TRUE(
      std::all_of(std::begin(message.signature), std::end(message.signature), [](auto b) { return b == 0; }));
}

TEST(GainTableMessage, PutsEachFieldWhereItsNameSays) {
  GainTable table;
  table.name = FixedString<48>("example");
  table.plant.joint_model = FixedString<32>("rhs17-6006");
  table.plant.gear = FixedString<32>("csf-17-50");
  table.plant.inertia_kgm2 = 0.089;
  table.plant.period_s = 0.001;
  table.friction.rule_count = 5;
  table.friction.rules[4].friction.viscous_Nms_rad = 0.27;
  table.primary.set(3, GainRow(-304.0, -967.1, -16.63), 2.0 * StateMatrix::Identity());
  table.primary.weights.torque = 1e-6;
  table.box.lead_periods = 2.0;
  table.box.cells[23].P[44] = 7.0;
  const gain_table_v1 message = to_message(table);
  EXPECT_EQ(std::string(std::begin(message.name), std::begin(message.name) + 8), std::string("example\0", 8));
  EXPECT_EQ(std::string(std::begin(message.joint_model), std::begin(message.joint_model) + 10), "rhs17-6006");
  EXPECT_EQ(std::string(std::begin(message.gear), std::begin(message.gear) + 9), "csf-17-50");
  EXPECT_EQ(message.inertia_kgm2, 0.089);
  EXPECT_EQ(message.period_s, 0.001);
  EXPECT_EQ(message.temperature_rule_count, 5);
  EXPECT_EQ(message.rule_viscous_Nms_rad[4], 0.27);
  EXPECT_EQ(message.primary.F[3][1], -967.1);
  EXPECT_EQ(message.primary.P[3][4], 2.0);
  EXPECT_EQ(message.primary.P[3][5], 0.0);
  EXPECT_EQ(message.primary.weight_torque, 1e-6);
  EXPECT_EQ(message.box_lead_periods, 2.0);
  EXPECT_EQ(message.box_cells[23].P[44], 7.0);
}

}  // namespace
}  // namespace strainwave
