// SPDX-License-Identifier: BSD-3-Clause
// Metrics of daemons, as a table, and the histograms of their loops.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/saturated_sum.h"
#include "lcmtypes/timing_buckets.h"
#include "strainwave/vocabulary.h"
#include "telemetry/fleet.h"

namespace strainwave {

namespace {

struct DaemonMetric {
  std::string_view name;
  MetricType type;
  std::string_view help;
  double (*value)(const timing_v1& timing);
};

constexpr double kSecondsPerNanosecond = 1e-9;

constexpr std::array kDaemonMetrics{
    DaemonMetric{"strainwave_cycles_total", MetricType::kCounter, "Periods of the loop.",
                 [](const timing_v1& t) { return real(t.cycles); }},
    DaemonMetric{"strainwave_overruns_total", MetricType::kCounter,
                 "Periods left out, since the one before took too long.",
                 [](const timing_v1& t) { return real(t.overruns); }},
    DaemonMetric{"strainwave_page_faults_total", MetricType::kCounter, "Page faults of the loop's thread.",
                 [](const timing_v1& t) { return real(t.page_faults); }},
    DaemonMetric{"strainwave_state_records_dropped_total", MetricType::kCounter,
                 "States that the gateway was too slow to publish.",
                 [](const timing_v1& t) { return real(t.state_records_dropped); }},
    DaemonMetric{"strainwave_period_seconds", MetricType::kGauge, "Period of the loop.",
                 [](const timing_v1& t) { return t.period_s; }},
    DaemonMetric{"strainwave_real_time", MetricType::kGauge,
                 "1: real-time scheduling with locked memory; 0: refused by the system.",
                 [](const timing_v1& t) { return real(t.real_time); }},
    DaemonMetric{"strainwave_joints", MetricType::kGauge, "Joints of the daemon.",
                 [](const timing_v1& t) { return real(t.joint_count); }},
    DaemonMetric{"strainwave_wakeup_latency_max_seconds", MetricType::kGauge,
                 "Largest wake-up latency since the start.",
                 [](const timing_v1& t) { return kSecondsPerNanosecond * real(t.wakeup_latency_max_ns); }},
    DaemonMetric{"strainwave_execution_time_max_seconds", MetricType::kGauge,
                 "Longest execution time of a period since the start.",
                 [](const timing_v1& t) { return kSecondsPerNanosecond * real(t.execution_time_max_ns); }},
};

/// Every fourth bound, a factor of two, suffices for alerts. More bounds would cost more time series.
constexpr std::size_t kStep = 4;

void expose_histogram(Exposition& page, std::string_view prefix, std::span<const std::int64_t> counts) {
  std::int64_t below = 0;
  // The last bucket has no upper bound.
  for (std::size_t i = 0; i < counts.size(); ++i) {
    below = saturated_sum(below, counts[i]);
    if (i % kStep != 0 || i + 1 == counts.size()) continue;
    page.sample(
        "_bucket",
        {{"prefix", prefix}, {"le", fmt::format("{:.6g}", kSecondsPerNanosecond * bucket_upper_ns(i))}},
        real(below));
  }
  page.sample("_bucket", {{"prefix", prefix}, {"le", "+Inf"}}, real(below));
  page.sample("_count", {{"prefix", prefix}}, real(below));
}

void expose_histograms(Exposition& page, const Fleet::Daemons& daemons) {
  page.family("strainwave_wakeup_latency_seconds", MetricType::kHistogram, "How late the loop woke up.");
  for (const auto& [prefix, daemon] : daemons)
    expose_histogram(page, prefix, daemon.timing.wakeup_latency_count);
  page.family("strainwave_execution_time_seconds", MetricType::kHistogram, "Execution time of a period.");
  for (const auto& [prefix, daemon] : daemons)
    expose_histogram(page, prefix, daemon.timing.execution_time_count);
  page.family("strainwave_position_delay_seconds", MetricType::kHistogram,
              "Time from a position's sampling until it came, for drives that allow its measurement.");
  for (const auto& [prefix, daemon] : daemons)
    if (daemon.timing.position_delay_max_ns > 0)
      expose_histogram(page, prefix, daemon.timing.position_delay_count);
}

void expose_refusals(Exposition& page, const Fleet::Daemons& daemons) {
  page.family("strainwave_orders_refused_total", MetricType::kCounter, "Messages refused, by reason.");
  for (const auto& [prefix, daemon] : daemons)
    for (int reason = 1; reason < kReasonCount; ++reason)
      page.sample({{"prefix", prefix}, {"reason", to_text(static_cast<Reason>(reason))}},
                  real(daemon.timing.rejects[reason]));
}

}  // namespace

void expose_daemons(Exposition& page, const Fleet::Daemons& daemons) {
  for (const DaemonMetric& metric : kDaemonMetrics) {
    page.family(metric.name, metric.type, metric.help);
    for (const auto& [prefix, daemon] : daemons)
      page.sample({{"prefix", prefix}}, metric.value(daemon.timing));
  }
  expose_histograms(page, daemons);
  expose_refusals(page, daemons);
}

}  // namespace strainwave
