// SPDX-License-Identifier: BSD-3-Clause
// Writes a page of metrics in Prometheus' text format 0.0.4: family after family, each with its samples. Not real-time.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace strainwave {

/// Names and values. They are Strainwave's own names and words of the vocabulary, and need no escapes.
using MetricLabels = std::vector<std::pair<std::string_view, std::string_view>>;

/// Converts a count or another field of a message.
template <typename Number>
constexpr double real(Number number) {
  return static_cast<double>(number);
}

enum class MetricType { kGauge, kCounter, kHistogram };

class Exposition {
 public:
  /// Begins a family. The next samples belong to it. A family without samples leaves no text.
  void family(std::string_view name, MetricType type, std::string_view help);
  void sample(const MetricLabels& labels, double value) { sample("", labels, value); }
  /// A sample of a histogram: `suffix` is "_bucket" or "_count".
  void sample(std::string_view suffix, const MetricLabels& labels, double value);

  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
  std::string name_;
  std::string heading_;  ///< heading of the family, until its first sample
};

}  // namespace strainwave
