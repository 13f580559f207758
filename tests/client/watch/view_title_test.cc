// SPDX-License-Identifier: BSD-3-Clause
// The first line of watch shows an alarm, if there is one, and as much more as fits.
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

#include "client/watch/view.h"
#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

TEST(WatchTitle, SaysWhoIsInTroubleBeforeAnythingElseOnANarrowScreen) {
  WatchModel many;
  many.daemons.push_back({"SW", {}, 0.1});
  for (int i = 0; i < 6; ++i) {
    many.joints.emplace_back();
    many.joints.back().joint = "joint" + std::to_string(i);
    many.joints.back().prefix = "SW";
  }
  EXPECT_EQ(render(many, 12, 60).text(0), "strainwave  6 joints of 1 daemon  commands are not signed");
  many.joints[4].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  EXPECT_EQ(render(many, 12, 40).text(0), "FAULT or SILENCE: joint4");
  EXPECT_EQ(render(many, 24, 80).text(0), "FAULT or SILENCE: joint4  6 joints of 1 daemon");
  many.joints[2].age_s = 2.5;
  many.joints[5].age_s = 2.5;
  EXPECT_EQ(render(many, 12, 39).text(0), "FAULT or SILENCE: joint2 and 2 more");
  EXPECT_EQ(render(many, 12, 40).text(0), "FAULT or SILENCE: joint2, joint4, joint5");
  EXPECT_EQ(render(many, 12, 30).text(0).substr(0, 23), "FAULT or SILENCE: joint");
}

TEST(WatchTitle, CountsNoFurtherThanANumberGoes) {
  WatchModel one;
  one.daemons.push_back({"SW", {}, 0.1});
  for (std::int64_t& count : one.daemons[0].timing.rejects) count = std::numeric_limits<std::int64_t>::max();
  EXPECT_NE(render(one, 24, 120).text(1).find("9223372036854775807 refused"), std::string::npos);
}

}  // namespace
}  // namespace strainwave
