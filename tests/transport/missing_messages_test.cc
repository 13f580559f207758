// SPDX-License-Identifier: BSD-3-Clause
#include "transport/missing_messages.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr LcmSource kSender{0x7f000001, 40001};
constexpr LcmSource kOther{0x7f000001, 40002};

TEST(MissingMessages, AreTheNumbersThatDidNotCome) {
  MissingMessages missing;
  for (const std::uint32_t sequence : {10U, 11U, 14U, 15U, 20U}) missing.heard(kSender, sequence);
  missing.heard(kOther, 3);
  missing.heard(kOther, 4);
  EXPECT_EQ(missing.of(kSender), 2U + 4U);
  EXPECT_EQ(missing.of(kOther), 0U);
  EXPECT_EQ(missing.of({1, 1}), 0U) << "never heard";
  missing.clear();
  missing.heard(kSender, 100);
  EXPECT_EQ(missing.of(kSender), 0U) << "what was before the first is unknown";
}

TEST(MissingMessages, ThatComeLateAreNotMissing) {
  MissingMessages missing;
  for (const std::uint32_t sequence : {1U, 4U, 2U, 3U, 5U}) missing.heard(kSender, sequence);
  EXPECT_EQ(missing.of(kSender), 0U);
}

TEST(MissingMessages, AreCountedWhereTheNumbersWrap) {
  MissingMessages missing;
  for (const std::uint32_t sequence : {UINT32_MAX - 1, UINT32_MAX, 0U, 2U}) missing.heard(kSender, sequence);
  EXPECT_EQ(missing.of(kSender), 1U);
}

TEST(MissingMessages, OfANewSenderOnAnOldPortAreNotTheOldOnes) {
  MissingMessages missing;
  for (const std::uint32_t sequence : {3'000'000'000U, 3'000'000'002U, 0U, 1U, 3U})
    missing.heard(kSender, sequence);
  EXPECT_EQ(missing.of(kSender), 1U + 1U);
}

TEST(MissingMessages, KnowsABoundedNumberOfSources) {
  MissingMessages missing;
  for (std::uint32_t i = 0; i < 10'000; ++i)
    for (const std::uint32_t sequence : {0U, 2U}) missing.heard({i, 1}, sequence);
  EXPECT_EQ(missing.of({0, 1}), 1U) << "the first ones keep their places";
  EXPECT_EQ(missing.of({9'999, 1}), 0U);
}

}  // namespace
}  // namespace strainwave
