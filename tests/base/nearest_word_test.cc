// SPDX-License-Identifier: BSD-3-Clause
#include "base/nearest_word.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

std::string nearest(const char* typed, const std::vector<std::string>& known) {
  const std::string* word = nearest_word(typed, known);
  return word == nullptr ? "" : *word;
}

TEST(NearestWord, ForgivesAForgottenUnitBeforeAMisspelling) {
  EXPECT_EQ(nearest("speed", {"spend", "speed_rad_s"}), "speed_rad_s");
  EXPECT_EQ(nearest("speed_rad_s", {"speed"}), "speed");
}

TEST(NearestWord, ForgivesSlipsOfThePen) {
  EXPECT_EQ(nearest("shwo", {"fit", "show", "verify"}), "show");
  EXPECT_EQ(nearest("positon_min_rad", {"position_max_rad", "position_min_rad"}), "position_min_rad");
  EXPECT_EQ(nearest("limit", {"limits", "control"}), "limits");
}

TEST(NearestWord, GuessesNothingFromAnotherWord) {
  EXPECT_EQ(nearest("banana", {"fit", "show"}), "");
  EXPECT_EQ(nearest("", {"fit", "show", "on"}), "");
  EXPECT_EQ(nearest("xy", {"on"}), "") << "every letter is another";
  EXPECT_EQ(nearest("fit", {}), "");
}

}  // namespace
}  // namespace strainwave
