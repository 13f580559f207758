// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string_view>

namespace strainwave {

namespace {

constexpr std::array<std::string_view, 8> kBars{"▁", "▂", "▃", "▄", "▅", "▆", "▇", "█"};
constexpr std::string_view kAsciiBars = ".:-=+*%#";
constexpr int kDotsAcross = 2;  // in a braille pattern
constexpr int kDotsDown = 4;

std::string bar(double share, bool unicode) {
  if (!std::isfinite(share)) return "?";
  const auto step = static_cast<std::size_t>(std::clamp(share * 8.0, 0.0, 7.0));
  return unicode ? std::string(kBars.at(step)) : std::string(1, kAsciiBars.at(step));
}

/// A field of dots, drawn as characters.
class Dots {
 public:
  Dots(int width, int height, bool unicode)
      : unicode_(unicode),
        across_(width * (unicode ? kDotsAcross : 1)),
        down_(height * (unicode ? kDotsDown : 1)),
        dots_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {}

  int across() const { return across_; }
  int down() const { return down_; }
  bool at(int x, int y) const {
    return dots_[static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) +
                 static_cast<std::size_t>(x)];
  }
  /// Fills a column between two heights, both included.
  void column(int x, int from, int to) {
    for (int y = std::min(from, to); y <= std::max(from, to); ++y)
      dots_[static_cast<std::size_t>(y) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(x)] =
          true;
  }

  std::vector<std::string> lines() const {
    const int step_x = unicode_ ? kDotsAcross : 1;
    const int step_y = unicode_ ? kDotsDown : 1;
    std::vector<std::string> result;
    for (int y = 0; y < down_; y += step_y) {
      std::string line;
      for (int x = 0; x < across_; x += step_x) line += unicode_ ? braille(x, y) : at(x, y) ? "*" : " ";
      result.push_back(std::move(line));
    }
    return result;
  }

 private:
  /// U+2800 plus one bit for each dot, in UTF-8.
  std::string braille(int x, int y) const {
    constexpr std::array<std::array<unsigned, kDotsDown>, kDotsAcross> kBits{
        {{0x01, 0x02, 0x04, 0x40}, {0x08, 0x10, 0x20, 0x80}}};
    unsigned bits = 0;
    for (int dx = 0; dx < kDotsAcross; ++dx)
      for (int dy = 0; dy < kDotsDown; ++dy)
        if (at(x + dx, y + dy)) bits |= kBits[static_cast<std::size_t>(dx)][static_cast<std::size_t>(dy)];
    if (bits == 0) return " ";
    return {'\xE2', static_cast<char>(0xA0U | (bits >> 6U)), static_cast<char>(0x80U | (bits & 0x3FU))};
  }

  bool unicode_;
  int across_;
  int down_;
  std::vector<bool> dots_;
};

}  // namespace

PlotScale scale_of(const std::deque<double>& values, std::size_t count, double least_span, bool with_zero) {
  std::optional<PlotScale> scale;
  if (with_zero) scale = PlotScale{0.0, 0.0};
  for (std::size_t i = values.size() - std::min(values.size(), count); i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    if (!scale) scale = PlotScale{values[i], values[i]};
    scale = PlotScale{std::min(scale->low, values[i]), std::max(scale->high, values[i])};
  }
  if (!scale) scale = PlotScale{0.0, 0.0};
  const double missing = least_span - (scale->high - scale->low);
  if (missing > 0.0) scale = PlotScale{scale->low - 0.5 * missing, scale->high + 0.5 * missing};
  return *scale;
}

std::string sparkline(const std::deque<double>& values, int width, double least_full, bool unicode) {
  const std::size_t count = std::min(values.size(), static_cast<std::size_t>(std::max(0, width)));
  double full = least_full;
  for (std::size_t i = values.size() - count; i < values.size(); ++i)
    if (std::isfinite(values[i])) full = std::max(full, std::abs(values[i]));
  std::string line;
  for (std::size_t i = values.size() - count; i < values.size(); ++i)
    line += std::isfinite(values[i]) ? bar(full > 0.0 ? std::abs(values[i]) / full : 0.0, unicode) : "?";
  return line;
}

std::size_t plot_capacity(int width, bool unicode) {
  return static_cast<std::size_t>(std::max(0, width) * (unicode ? kDotsAcross : 1));
}

std::vector<std::string> plot(const std::deque<double>& values, const PlotScale& scale, int width, int height,
                              bool unicode) {
  if (width <= 0 || height <= 0) return {};
  Dots dots(width, height, unicode);
  const double span = scale.high - scale.low;
  const auto count = static_cast<int>(std::min(values.size(), static_cast<std::size_t>(dots.across())));
  std::optional<int> before;
  for (int i = 0; i < count; ++i) {
    const double value = values[values.size() - static_cast<std::size_t>(count - i)];
    const double share = span > 0.0 ? (value - scale.low) / span : 0.5;
    if (!std::isfinite(share)) {
      before.reset();
      continue;
    }
    const int y = static_cast<int>(std::lround((1.0 - std::clamp(share, 0.0, 1.0)) * (dots.down() - 1)));
    dots.column(dots.across() - count + i, before.value_or(y), y);
    before = y;
  }
  return dots.lines();
}

}  // namespace strainwave
