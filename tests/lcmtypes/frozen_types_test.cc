// SPDX-License-Identifier: BSD-3-Clause
// Published message types are frozen. A changed field changes LCM's fingerprint, and needs a new type with the next number.
#include <gtest/gtest.h>

#include <cstdint>
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

namespace strainwave {
namespace {

template <typename Message>
std::uint64_t fingerprint() {
  return static_cast<std::uint64_t>(Message::getHash());
}

TEST(FrozenTypes, HaveTheFieldsThatWerePublished) {
  EXPECT_EQ(fingerprint<ack_v1>(), 0x82d7df652d728441U);
  EXPECT_EQ(fingerprint<command_v1>(), 0xb99e1b4d9ae42861U);
  EXPECT_EQ(fingerprint<gain_table_v1>(), 0xdb6a757ecb8cb204U);
  EXPECT_EQ(fingerprint<inject_v1>(), 0x740869769984fd92U);
  EXPECT_EQ(fingerprint<limits_v1>(), 0x8b0bbfd398c04487U);
  EXPECT_EQ(fingerprint<path_v1>(), 0xbd18419761c5acccU);
  EXPECT_EQ(fingerprint<setpoint_v1>(), 0xd2c69ab87ad7d7caU);
  EXPECT_EQ(fingerprint<state_v1>(), 0xcd9a0d82bd8ba4a1U);
  EXPECT_EQ(fingerprint<temperature_v1>(), 0x5585d0eb7ef40d8bU);
  EXPECT_EQ(fingerprint<timing_v1>(), 0xaff0471f114f01f7U);
}

}  // namespace
}  // namespace strainwave
