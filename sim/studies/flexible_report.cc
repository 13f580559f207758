// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/flexible_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/parallel.h"
#include "base/printable.h"
#include "sim/studies/statistics.h"

namespace strainwave {

namespace {

template <typename Value>
std::vector<double> values_of(const std::vector<FlexibleRow>& rows, std::size_t contender,
                              const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const FlexibleRow& row : rows) values.push_back(value(row.results[contender]));
  return values;
}

}  // namespace

TextTable price_table(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged) {
  TextTable table;
  table.title = "The price: " + contenders[judged].name +
                ", cell by cell, over each other controller (link above 40 urad)";
  table.header = {"against", "step (rad)", "mean", "5 %", "median", "95 %", "worst", "better in", "worse in"};
  std::set<double> steps;
  for (const FlexibleRow& row : rows) steps.insert(row.cell.step_rad);
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    if (c == judged) continue;
    for (const double step_rad : steps) {
      std::vector<double> prices;
      for (const FlexibleRow& row : rows)
        if (row.cell.step_rad == step_rad)
          prices.push_back(row.results[judged].link_counted_ratio / row.results[c].link_counted_ratio);
      const auto better = std::count_if(prices.begin(), prices.end(), [](double p) { return p < 1.0; });
      const auto worse = std::count_if(prices.begin(), prices.end(), [](double p) { return p > 1.0; });
      std::vector<std::string> fields = {contenders[c].name, number(step_rad),
                                         number(geometric_mean(prices), 3)};
      for (const double share : {0.05, 0.5, 0.95, 1.0})
        fields.push_back(number(percentile(prices, share), 3));
      fields.push_back(std::to_string(better));
      fields.push_back(std::to_string(worse));
      table.rows.push_back(fields);
    }
  }
  return table;
}

TextTable price_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                      std::size_t judged) {
  TextTable table;
  table.header = {"link_inertia_kgm2", "stiffness_scale", "damping_ratio", "temperature_C", "step_rad"};
  for (const Contender& contender : contenders) {
    table.header.push_back(contender.name);
    if (&contender != &contenders[judged]) table.header.push_back("over " + contender.name);
  }
  for (const FlexibleRow& row : rows) {
    std::vector<std::string> fields;
    for (const double value : {row.cell.link_inertia_kgm2, row.cell.stiffness_scale, row.cell.damping_ratio,
                               row.cell.temperature_C, row.cell.step_rad})
      fields.push_back(number(value, 9));
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      const double ratio = row.results[c].link_counted_ratio;
      fields.push_back(number(ratio, 6));
      if (c != judged) fields.push_back(number(row.results[judged].link_counted_ratio / ratio, 6));
    }
    table.rows.push_back(fields);
  }
  return table;
}

TextTable lost_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders,
                     std::size_t judged) {
  TextTable table;
  table.title = "Cells that " + contenders[judged].name + " loses (link above 40 urad, over the limit)";
  table.header = {"against",    "link (kg.m2)", "stiffness", "damping", "temperature (degC)",
                  "step (rad)", "its ratio",    "theirs"};
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    if (c == judged) continue;
    for (const FlexibleRow& row : rows) {
      const double its = row.results[judged].link_counted_ratio;
      const double theirs = row.results[c].link_counted_ratio;
      if (its < theirs) continue;
      table.rows.push_back({contenders[c].name, number(row.cell.link_inertia_kgm2),
                            number(row.cell.stiffness_scale), number(row.cell.damping_ratio),
                            number(row.cell.temperature_C), number(row.cell.step_rad), number(its),
                            number(theirs)});
    }
  }
  return table;
}

TextTable flexible_cells(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders) {
  TextTable table;
  table.header = {"controller",
                  "link_inertia_kgm2",
                  "stiffness_scale",
                  "damping_ratio",
                  "temperature_C",
                  "step_rad",
                  "effect",
                  "limit_pi2",
                  "link_over_limit",
                  "link_over_limit_above_40urad",
                  "motor_over_limit",
                  "motor_over_limit_above_40urad",
                  "settling_time_s",
                  "overshoot_rad",
                  "rest_peak_Nm",
                  "rest_rms_Nm",
                  "rest_sign_changes_per_s",
                  "rest_swing_rad",
                  "oscillates",
                  "switched_off",
                  "diverged"};
  for (const FlexibleRow& row : rows)
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      const FlexibleResult& r = row.results[c];
      std::vector<std::string> fields = {contenders[c].name};
      for (const double value : {row.cell.link_inertia_kgm2, row.cell.stiffness_scale, row.cell.damping_ratio,
                                 row.cell.temperature_C, row.cell.step_rad})
        fields.push_back(number(value, 9));
      fields.push_back(row.cell.effect);
      for (const double value : {row.limit_pi2, r.link_ratio, r.link_counted_ratio, r.motor_ratio,
                                 r.motor_counted_ratio, r.settling_time_s, r.overshoot_rad, r.rest_peak_Nm,
                                 r.rest_rms_Nm, r.rest_sign_changes_per_s, r.rest_swing_rad})
        fields.push_back(number(value, 6));
      fields.emplace_back(r.oscillates ? "yes" : "no");
      fields.emplace_back(r.switched_off ? "yes" : "no");
      fields.emplace_back(r.diverged ? "yes" : "no");
      table.rows.push_back(fields);
    }
  return table;
}

TextTable flexible_summary(const std::string& title, const std::vector<FlexibleRow>& rows,
                           const std::vector<Contender>& contenders) {
  TextTable table;
  table.title = title + ", " + counted(rows.size(), "cell");
  table.header = {"controller",
                  "link over limit, mean",
                  "95 %",
                  "worst",
                  "above 40 urad, mean",
                  "95 %",
                  "settles within 2 counts",
                  "worst overshoot (mrad)",
                  "peak torque at rest (N.m), 95 %",
                  "oscillating",
                  "switched off",
                  "diverged"};
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const auto all = values_of(rows, c, [](const FlexibleResult& r) { return r.link_ratio; });
    const auto counted = values_of(rows, c, [](const FlexibleResult& r) { return r.link_counted_ratio; });
    const auto overshoot = values_of(rows, c, [](const FlexibleResult& r) { return 1e3 * r.overshoot_rad; });
    const auto rest = values_of(rows, c, [](const FlexibleResult& r) { return r.rest_peak_Nm; });
    const auto count = [&](const auto& of) {
      return std::to_string(std::count_if(rows.begin(), rows.end(),
                                          [&](const FlexibleRow& row) { return of(row.results[c]); }));
    };
    table.rows.push_back({contenders[c].name, number(geometric_mean(all), 3),
                          number(percentile(all, 0.95), 3), number(percentile(all, 1.0), 3),
                          number(geometric_mean(counted), 3), number(percentile(counted, 0.95), 3),
                          count([](const FlexibleResult& r) { return r.settling_time_s >= 0.0; }),
                          number(percentile(overshoot, 1.0), 3), number(percentile(rest, 0.95), 3),
                          count([](const FlexibleResult& r) { return r.oscillates; }),
                          count([](const FlexibleResult& r) { return r.switched_off; }),
                          count([](const FlexibleResult& r) { return r.diverged; })});
  }
  return table;
}

TextTable effect_ranking(const std::vector<FlexibleRow>& rows, const std::vector<Contender>& contenders) {
  struct Cost {
    std::vector<std::vector<double>> ratios;
    std::vector<int> oscillating;
  };
  std::map<std::string, Cost> costs;
  for (const FlexibleRow& row : rows) {
    Cost& cost = costs[row.cell.effect];
    cost.ratios.resize(contenders.size());
    cost.oscillating.resize(contenders.size());
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      // A run that diverged counts with a large finite ratio, because an infinite one would hide all others.
      cost.ratios[c].push_back(std::min(1e6, row.results[c].link_counted_ratio));
      cost.oscillating[c] += row.results[c].oscillates ? 1 : 0;
    }
  }
  TextTable table;
  table.title = "Effects, link above 40 urad over the limit (geometric mean), and cells that oscillate";
  table.header = {"effect"};
  for (const Contender& contender : contenders) {
    table.header.push_back(contender.name);
    table.header.push_back("oscillating");
  }
  std::vector<std::pair<double, std::vector<std::string>>> ranked;
  const std::size_t judged = std::min<std::size_t>(2, contenders.size() - 1);
  for (const auto& [effect, cost] : costs) {
    std::vector<std::string> fields = {effect};
    for (std::size_t c = 0; c < contenders.size(); ++c) {
      fields.push_back(number(geometric_mean(cost.ratios[c]), 3));
      fields.push_back(std::to_string(cost.oscillating[c]) + " of " + std::to_string(cost.ratios[c].size()));
    }
    ranked.emplace_back(-geometric_mean(cost.ratios[judged]), fields);
  }
  std::sort(ranked.begin(), ranked.end());
  for (const auto& [cost, fields] : ranked) table.rows.push_back(fields);
  return table;
}

}  // namespace strainwave
