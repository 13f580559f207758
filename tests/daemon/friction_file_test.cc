// SPDX-License-Identifier: BSD-3-Clause
// The file of learned friction: the daemon reads what it has written, and refuses anything else.
#include "daemon/friction_file.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

KeptFriction example() {
  KeptFriction kept{
      .joint = "elbow", .friction_rules_id = -77, .learned_C = 21.5, .learned_utime = 1'700'000'000'000'000};
  kept.scale[0] = -0.25;
  kept.scale[15] = 2.5;
  return kept;
}

std::string replaced(const std::string& from, const std::string& to) {
  std::string text = to_json(example());
  return text.replace(text.find(from), from.size(), to);
}

std::string complaint(const std::string& text) {
  return testing::refusal_of([&] { (void)parse_kept_friction(text, "f.json"); });
}

TEST(FrictionFile, IsReadAsItWasWritten) {
  const KeptFriction read = parse_kept_friction(to_json(example()), "f.json");
  EXPECT_EQ(read.joint, "elbow");
  EXPECT_EQ(read.friction_rules_id, -77);
  EXPECT_EQ(read.scale, example().scale);
  EXPECT_EQ(read.learned_C, 21.5);
  EXPECT_EQ(read.learned_utime, 1'700'000'000'000'000);
}

TEST(FrictionFile, RefusesAScaleThatNothingMayLearn) {
  for (const char* scale : {"-0.91", "3.01", "1e300", "null", "\"1\""}) {
    const std::string text = complaint(replaced("-0.25", scale));
    EXPECT_NE(text.find("friction_scales"), std::string::npos) << text;
  }
}

TEST(FrictionFile, RefusesTemperaturesAndTimesThatCannotBe) {
  EXPECT_NE(complaint(replaced("21.5", "-300.0")).find("friction_learned_C"), std::string::npos);
  EXPECT_NE(complaint(replaced("1700000000000000", "-1")).find("friction_learned_utime"), std::string::npos);
}

TEST(FrictionFile, RefusesWhatIsCutOffEmptyOrHasOtherKeys) {
  const std::string text = to_json(example());
  for (std::size_t size = 0; size + 2 < text.size(); size += 7)
    EXPECT_NE(complaint(text.substr(0, size)), "accepted");
  EXPECT_NE(complaint(replaced("\"joint\"", "\"hinge\"")), "accepted");
}

}  // namespace
}  // namespace strainwave
