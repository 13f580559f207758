// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/palette.h"

#include <gtest/gtest.h>

#include <array>
#include <tuple>

#include "tests/client/watch/screen_picture.h"

namespace strainwave {
namespace {

using testing::contrast;

constexpr std::array kStyles{Style::kPlain, Style::kDim,     Style::kTitle,
                             Style::kGood,  Style::kWarning, Style::kAlarm};

TEST(Palette, IsReadOnBlackAndOnWhite) {
  constexpr int kBlack = 16;
  constexpr int kWhite = 231;
  for (const Style style : kStyles) {
    const Paint paint = paint_of(style, Colours::kMany);
    if (paint.foreground < 0) continue;  // the terminal's own colours
    ASSERT_GE(paint.foreground, 16);
    for (const int background : {kBlack, kWhite})
      EXPECT_GE(contrast(paint.foreground, paint.background < 0 ? background : paint.background), 4.5)
          << static_cast<int>(style) << " on " << background;
  }
}

TEST(Palette, TellsAlarmAndWarningFromTheRestWithAnyNumberOfColours) {
  const auto all = [](const Paint& paint) {
    return std::tuple(paint.foreground, paint.background, paint.bold, paint.dim, paint.underlined);
  };
  for (const Colours colours : {Colours::kNone, Colours::kEight, Colours::kMany}) {
    for (const Style important : {Style::kWarning, Style::kAlarm}) {
      for (const Style other : kStyles) {
        if (other == important) continue;
        EXPECT_NE(all(paint_of(important, colours)), all(paint_of(other, colours)));
      }
    }
  }
}

}  // namespace
}  // namespace strainwave
