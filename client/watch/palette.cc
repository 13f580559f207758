// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/palette.h"

namespace strainwave {

namespace {

// Colour numbers of xterm. The middle grey and the middle green reach a contrast of 4.5 to 1 (WCAG 2.1, AA) on black and on white.
constexpr int kBlack = 0;
constexpr int kRed = 1;
constexpr int kYellow = 3;
constexpr int kWhite = 7;
constexpr int kTrueBlack = 16;
constexpr int kGreen29 = 29;
constexpr int kRed160 = 160;
constexpr int kAmber214 = 214;
constexpr int kTrueWhite = 231;
constexpr int kGrey243 = 243;

Paint without_colours(Style style) noexcept {
  switch (style) {
    case Style::kDim:
      return {-1, -1, false, true, false};
    case Style::kTitle:
      return {-1, -1, true, false, false};
    case Style::kWarning:
      return {-1, -1, false, false, true};
    case Style::kAlarm:
      return {-1, -1, true, false, true};
    case Style::kPlain:
    case Style::kGood:
      break;
  }
  return {};
}

}  // namespace

Paint paint_of(Style style, Colours colours) noexcept {
  if (colours == Colours::kNone) return without_colours(style);
  const bool many = colours == Colours::kMany;
  switch (style) {
    case Style::kDim:
      return many ? Paint{kGrey243} : Paint{-1, -1, false, true, false};
    case Style::kTitle:
      return {-1, -1, true, false, false};
    case Style::kGood:
      return many ? Paint{kGreen29} : Paint{};
    case Style::kWarning:
      return many ? Paint{kTrueBlack, kAmber214} : Paint{kBlack, kYellow};
    case Style::kAlarm:
      return many ? Paint{kTrueWhite, kRed160, true} : Paint{kWhite, kRed, true};
    case Style::kPlain:
      break;
  }
  return {};
}

}  // namespace strainwave
