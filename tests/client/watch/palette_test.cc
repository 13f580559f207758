#include "client/watch/palette.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <tuple>

namespace strainwave {
namespace {

constexpr std::array kStyles{Style::kPlain, Style::kDim,     Style::kTitle,
                             Style::kGood,  Style::kWarning, Style::kAlarm};

/// Relative luminance of a colour of xterm's 256 (WCAG 2.1); only its cube and greys, which no user changes.
double luminance(int colour) {
  std::array<int, 3> levels{};
  if (colour >= 232) {
    levels.fill(8 + 10 * (colour - 232));
  } else {
    const int index = colour - 16;
    const auto level = [](int step) { return step == 0 ? 0 : 55 + 40 * step; };
    levels = {level(index / 36), level(index / 6 % 6), level(index % 6)};
  }
  const auto linear = [](int value) {
    const double share = value / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(levels[0]) + 0.7152 * linear(levels[1]) + 0.0722 * linear(levels[2]);
}

double contrast(int a, int b) {
  const double first = luminance(a);
  const double second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

TEST(Palette, IsReadOnBlackAndOnWhite) {
  constexpr int kBlack = 16;
  constexpr int kWhite = 231;
  for (const Style style : kStyles) {
    const Paint paint = paint_of(style, Colours::kMany);
    if (paint.foreground < 0) continue;  // the terminal's own on its own
    ASSERT_GE(paint.foreground, 16);
    for (const int background : {kBlack, kWhite})
      EXPECT_GE(contrast(paint.foreground, paint.background < 0 ? background : paint.background), 4.0)
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
