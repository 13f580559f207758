// SPDX-License-Identifier: BSD-3-Clause
// Values over time in characters. Pure. Not real-time.
#pragma once

#include <deque>
#include <string>
#include <vector>

namespace strainwave {

/// The range of values that a plot shows.
struct PlotScale {
  double low = 0.0;
  double high = 1.0;
};

/// Holds the last `count` finite values, and 0 if `with_zero`; at least `least_span` wide, so that noise does not fill the plot.
PlotScale scale_of(const std::deque<double>& values, std::size_t count, double least_span, bool with_zero);

/// |values| as bars, the latest last, at most `width` of them; a full bar is the largest one, but at least `least_full`.
std::string sparkline(const std::deque<double>& values, int width, double least_full, bool unicode);

/// How many values fit into `width` characters: two in each of Unicode's braille patterns.
std::size_t plot_capacity(int width, bool unicode);

/// `height` lines of `width` characters with the latest values at the right.
std::vector<std::string> plot(const std::deque<double>& values, const PlotScale& scale, int width, int height,
                              bool unicode);

}  // namespace strainwave
