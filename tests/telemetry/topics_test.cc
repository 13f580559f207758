// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/topics.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(Topics, KeepTheirNumberAndNeverGetAnothers) {
  Topics topics;
  const std::uint32_t first = topics.add("SW.a.STATE", "s", "{}", 0.0)->id;
  const std::uint32_t second = topics.add("SW.b.STATE", "s", "{}", 0.0)->id;
  EXPECT_NE(first, second);
  ASSERT_NE(topics.find("SW.a.STATE", 1.0), nullptr);
  EXPECT_EQ(topics.find("SW.a.STATE", 1.0)->id, first);
  EXPECT_EQ(topics.find("SW.c.STATE", 1.0), nullptr);
}

TEST(Topics, GiveUpOfWhoHasTheMostWhatIsSilentTheLongest) {
  Topics topics;
  const LcmSource daemon{1, 1};
  const LcmSource flooder{2, 1};
  ASSERT_NE(topics.add("SW.a.STATE", "s", "{}", 0.0, daemon), nullptr);
  const std::uint32_t silent = topics.add("SW.silent.STATE", "s", "{}", 1.0, flooder)->id;
  for (std::size_t i = 2; i < Topics::kMax; ++i)
    ASSERT_NE(topics.add("SW.j" + std::to_string(i) + ".STATE", "s", "{}", 2.0, flooder), nullptr);
  EXPECT_FALSE(topics.given_up());
  const Topic* added = topics.add("SW.new.STATE", "s", "{}", 2.5, daemon);
  ASSERT_NE(added, nullptr);
  EXPECT_EQ(topics.given_up(), silent);
  EXPECT_FALSE(topics.has(silent));
  EXPECT_NE(added->id, silent);
  EXPECT_EQ(topics.size(), Topics::kMax);
  for (int i = 0; i < 3000; ++i)
    (void)topics.add("F." + std::to_string(i) + ".STATE", "s", "{}", 3.0, flooder);
  EXPECT_NE(topics.find("SW.a.STATE", 3.0), nullptr);
  EXPECT_NE(topics.find("SW.new.STATE", 3.0), nullptr);
}

TEST(Topics, AreNotMadeFasterThanViewersCanBeToldOfThem) {
  Topics topics;
  constexpr double kLasts_s = 10.0;
  constexpr int kMadeUp = 100000;
  int added = 0;
  for (int i = 0; i < kMadeUp; ++i)
    if (topics.add("F.j" + std::to_string(i) + ".STATE", "s", "{}", kLasts_s * i / kMadeUp, {2, 1}) !=
        nullptr)
      ++added;
  EXPECT_GE(added, static_cast<int>(Topics::kMax));
  EXPECT_LE(added, static_cast<int>(Topics::kMax) + static_cast<int>(kLasts_s * Topics::kNewPerSecond) + 1);
  // A topic of another source must soon get a place, even during the flood.
  const Topic* own = nullptr;
  for (int i = 0; i < 5000 && own == nullptr; ++i) {
    const double now_s = kLasts_s + 0.001 * i;
    for (int k = 0; k < 10; ++k)
      (void)topics.add("G.j" + std::to_string(10 * i + k) + ".STATE", "s", "{}", now_s, {2, 1});
    own = topics.add("SW.elbow.STATE", "s", "{}", now_s + 0.0005, {1, 1});
  }
  EXPECT_NE(own, nullptr);
}

}  // namespace
}  // namespace strainwave
