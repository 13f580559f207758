// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/admission/fair_share.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
constexpr std::uint64_t kNewcomer = 1'000'000;
constexpr std::uint64_t kElsewhere = 4'000'000'000;  // another address
constexpr std::uint64_t kSalt = 4711;

/// Floods from `sources` sources with `per_ms` requests in each millisecond from `from_ms` to `until_ms`.
/// Returns the number of granted requests.
int flood(FairShare& share, std::uint64_t sources, int per_ms, std::int64_t from_ms, std::int64_t until_ms) {
  int granted = 0;
  std::uint64_t turn = 0;
  for (std::int64_t ms = from_ms; ms < until_ms; ++ms)
    for (int i = 0; i < per_ms; ++i)
      granted += share.try_take(1 + turn++ % sources, ms * kMillisecond_ns) ? 1 : 0;
  return granted;
}

TEST(FairShare, GivesAllTogetherTheirRateAndNoMoreThanTheBurstBesides) {
  for (const std::uint64_t sources : {1U, 8U, 100U, 1000U, 100'000U}) {
    FairShare share(1000.0, 200.0, kSalt);
    const int granted = flood(share, sources, 50, 0, 10'000);
    EXPECT_GE(granted, 10'000 - 50) << sources;
    EXPECT_LE(granted, 10'000 + 200) << sources;
  }
}

TEST(FairShare, GivesOneThatComesForTheFirstTimeHisWhoeverFloods) {
  for (const std::uint64_t sources : {1U, 2U, 8U, 50U, 200U, 300U, 500U, 1000U, 2000U}) {
    FairShare share(1000.0, 200.0, kSalt);
    for (int i = 0; i < 100; ++i) {
      flood(share, sources, 50, 100 * i, 100 * (i + 1));
      EXPECT_TRUE(share.try_take(kNewcomer + static_cast<std::uint64_t>(i), 100 * (i + 1) * kMillisecond_ns))
          << sources << " sources, newcomer " << i;
    }
  }
}

TEST(FairShare, GivesOneThatComesNowAndThenHisEachTime) {
  FairShare share(1000.0, 200.0, kSalt);
  for (int i = 0; i < 200; ++i) {
    flood(share, 8, 50, 50 * i, 50 * (i + 1));
    EXPECT_TRUE(share.try_take(kNewcomer, 50 * (i + 1) * kMillisecond_ns)) << i;
  }
}

TEST(FairShare, KeepsTheLastOfTheReserveForThoseWhoProvedWhoTheyAre) {
  FairShare share(1000.0, 200.0, kSalt);
  share.prove(kNewcomer, 0);
  // More sources than are remembered, so that each of them looks like a new one.
  flood(share, 100'000, 50, 0, 5000);
  EXPECT_FALSE(share.available(kElsewhere, 4999 * kMillisecond_ns));
  EXPECT_TRUE(share.available(kNewcomer, 4999 * kMillisecond_ns));
}

TEST(FairShare, KeepsWhatIsLastButThatForWhatComesFromTheirAddresses) {
  FairShare share(1000.0, 200.0, kSalt);
  share.prove(kElsewhere, 0);
  flood(share, 100'000, 50, 0, 5000);
  EXPECT_TRUE(share.available(kElsewhere + 1, 4999 * kMillisecond_ns)) << "another port";
  EXPECT_FALSE(share.available(2 * kElsewhere, 4999 * kMillisecond_ns));
}

TEST(FairShare, ForgetsTheOldestProofForTheNewest) {
  FairShare share(1000.0, 200.0, kSalt);
  for (std::uint64_t i = 0; i <= FairShare::kProven; ++i)
    share.prove(i, static_cast<std::int64_t>(i) * kMillisecond_ns);
  flood(share, 100'000, 50, 100, 5000);
  const std::int64_t now_ns = 4999 * kMillisecond_ns;
  EXPECT_FALSE(share.available(0, now_ns));
  EXPECT_TRUE(share.available(1, now_ns));
  EXPECT_TRUE(share.available(FairShare::kProven, now_ns));
}

TEST(FairShare, OfAProvenSourceIsBoundedByWhatItTookLikeAnyOther) {
  FairShare share(1000.0, 200.0, kSalt);
  share.prove(1, 0);
  flood(share, 1, 50, 0, 5000);
  EXPECT_TRUE(share.try_take(kNewcomer, 5000 * kMillisecond_ns));
}

TEST(FairShare, IsGivenBackWithTime) {
  FairShare share(1000.0, 200.0, kSalt);
  const int at_once = flood(share, 1, 1000, 0, 1);
  EXPECT_LT(flood(share, 1, 1000, 1, 2), 10);
  EXPECT_EQ(flood(share, 1, 1000, 100'000, 100'001), at_once);
}

}  // namespace
}  // namespace strainwave
