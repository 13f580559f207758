// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/exposition.h"

#include <fmt/format.h>

#include <cmath>

namespace strainwave {

namespace {

std::string_view word(MetricType type) {
  switch (type) {
    case MetricType::kGauge:
      return "gauge";
    case MetricType::kCounter:
      return "counter";
    case MetricType::kHistogram:
      return "histogram";
  }
  return "untyped";
}

std::string number(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0.0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);
}

}  // namespace

void Exposition::family(std::string_view name, MetricType type, std::string_view help) {
  name_ = name;
  heading_ = fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", name, help, word(type));
}

void Exposition::sample(std::string_view suffix, const MetricLabels& labels, double value) {
  text_ += heading_;
  heading_.clear();
  text_ += name_;
  text_ += suffix;
  char before = '{';
  for (const auto& [name, word] : labels) {
    text_ += fmt::format("{}{}=\"{}\"", before, name, word);
    before = ',';
  }
  text_ += labels.empty() ? " " : "} ";
  text_ += number(value);
  text_ += '\n';
}

}  // namespace strainwave
