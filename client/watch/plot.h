// SPDX-License-Identifier: BSD-3-Clause
// Plots of values over time, made of characters. Pure. Not real-time.
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

/// Holds the last `count` finite values, and 0 if `with_zero`. It is at least `least_span` wide, so that noise does not fill the plot.
PlotScale scale_of(const std::deque<double>& values, std::size_t count, double least_span, bool with_zero);

/// |values| as bars, the latest last, at most `width` of them. A full bar is the largest value, but at least `least_full`.
std::string sparkline(const std::deque<double>& values, int width, double least_full, bool unicode);

/// Number of values in `width` characters: two per character with Unicode's braille patterns.
std::size_t plot_capacity(int width, bool unicode);

/// `height` lines of `width` characters with the latest values at the right.
std::vector<std::string> plot(const std::deque<double>& values, const PlotScale& scale, int width, int height,
                              bool unicode);

}  // namespace strainwave
