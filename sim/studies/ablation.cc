// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/ablation.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "sim/studies/link_limit.h"
#include "sim/studies/statistics.h"
#include "sim/studies/temperature_study.h"

namespace strainwave {

namespace {

constexpr std::array kSteps_rad = {1e-3, 1e-2, 0.1, 1.0};
constexpr double kLargestLink_kgm2 = 0.27;
constexpr double kLoad_Nm = 5.0;  // with the link horizontal, about that of 1.3 kg at 0.4 m

struct Cell {
  FlexibleCell cell;
  FlexibleResult result;
};

std::vector<Cell> run_cells(const std::vector<FlexibleCell>& cells, const Contender& contender) {
  std::vector<Cell> done;
  done.reserve(cells.size());
  for (const FlexibleCell& cell : cells) done.push_back({cell, {}});
  run_in_parallel(done.size(),
                  [&](std::size_t i) { done[i].result = run_without_limit(done[i].cell, contender); });
  return done;
}

bool lost(const FlexibleResult& result) noexcept {
  return result.settling_time_s < 0.0 || result.oscillates || result.switched_off || result.diverged;
}

void judge_grid(const std::vector<Cell>& cells, AblationRow& row) {
  std::array<std::vector<double>, kSteps_rad.size()> sums;
  std::vector<double> rest_Nm;
  for (const Cell& one : cells) {
    row.unsettled += lost(one.result) ? 1.0 : 0.0;
    rest_Nm.push_back(one.result.rest_peak_Nm);
    if (one.cell.link_inertia_kgm2 > kLargestLink_kgm2) continue;
    row.overshoot_rad = std::max(row.overshoot_rad, one.result.overshoot_rad);
    for (std::size_t i = 0; i < kSteps_rad.size(); ++i)
      if (one.cell.step_rad == kSteps_rad[i]) sums[i].push_back(one.result.link_ratio);
  }
  for (std::size_t i = 0; i < kSteps_rad.size(); ++i) row.step_sums[i] = percentile(sums[i], 0.5);
  row.rest_torque_Nm = percentile(rest_Nm, 0.95);
}

void judge_wrong(const std::vector<Cell>& cells, AblationRow& row) {
  for (const Cell& one : cells) {
    const bool off = one.result.switched_off || one.result.diverged;
    row.wrong_off += off || one.result.rest_error_rad > kCountedError_rad ? 1.0 : 0.0;
    if (off) continue;
    row.wrong_worst_rad = std::max(row.wrong_worst_rad, one.result.rest_error_rad);
    row.wrong_overshoot_rad = std::max(row.wrong_overshoot_rad, one.result.overshoot_rad);
  }
}

std::vector<FlexibleCell> loaded_grid() {
  std::vector<FlexibleCell> cells = flexible_grid();
  for (FlexibleCell& cell : cells) cell.plant.effects.gravity.torque_Nm = kLoad_Nm;
  return cells;
}

double rest_error_rad(const std::vector<Cell>& cells) {
  std::vector<double> errors_rad;
  errors_rad.reserve(cells.size());
  for (const Cell& one : cells) errors_rad.push_back(one.result.rest_error_rad);
  return percentile(errors_rad, 0.95);
}

double mean_rms_rad(const FrictionWay& way, int times) {
  const std::vector<TemperatureRow> rows = run_temperatures({way}, {{"right", 0.0}}, times);
  double sum_rad = 0.0;
  for (const TemperatureRow& row : rows) sum_rad += row.error.rms_rad;
  return sum_rad / static_cast<double>(rows.size());
}

/// The figures that are compared, in the order of the columns.
std::vector<double> figures(const AblationRow& row) {
  std::vector<double> all(row.step_sums.begin(), row.step_sums.end());
  for (const double figure : {row.overshoot_rad, row.rest_torque_Nm, row.unsettled, row.wrong_off,
                              row.wrong_worst_rad, row.wrong_overshoot_rad, row.random_rest_rad,
                              row.load_rest_rad, row.first_rms_rad, row.sixth_rms_rad})
    all.push_back(figure);
  return all;
}

}  // namespace

std::string_view name_of(Mechanism mechanism) noexcept {
  switch (mechanism) {
    case Mechanism::kNone:
      return "none";
    case Mechanism::kWindUp:
      return "wind-up in the plan";
    case Mechanism::kFriction:
      return "friction feed-forward";
    case Mechanism::kFrictionLearning:
      return "learning of friction";
    case Mechanism::kLoadLearning:
      return "learning of the load";
    case Mechanism::kRestTorque:
      return "constant torque at rest";
    case Mechanism::kCorrections:
      return "corrections at rest";
    case Mechanism::kPace:
      return "pace under a limited torque";
    case Mechanism::kGivingWay:
      return "plan that gives way";
  }
  return "";
}

AblationRow run_without(Mechanism without, const FlexibleTables& tables, int random, std::uint64_t seed) {
  AblationRow row;
  row.without = without;
  const Contender daemon = daemon_contender(tables, without);
  judge_grid(run_cells(flexible_grid(), daemon), row);
  judge_wrong(run_cells(wrongly_configured_grid(), daemon), row);
  row.random_rest_rad = rest_error_rad(run_cells(wrongly_configured_joints(random, seed), daemon));
  row.load_rest_rad = rest_error_rad(run_cells(loaded_grid(), daemon));
  const FrictionWay way = product_way_without(tables, without);
  row.first_rms_rad = mean_rms_rad(way, 1);
  row.sixth_rms_rad = mean_rms_rad(way, kLearnedAfter);
  return row;
}

double worth(const AblationRow& without, const AblationRow& complete) noexcept {
  const std::vector<double> before = figures(complete);
  const std::vector<double> after = figures(without);
  double most = 0.0;
  // A count of lost cells that was 0 has no growth in per cent.
  for (std::size_t i = 0; i < before.size(); ++i)
    if (before[i] > 0.0) most = std::max(most, after[i] / before[i] - 1.0);
  return most;
}

TextTable ablation_table(const std::vector<AblationRow>& rows) {
  TextTable table;
  table.title = "What each part of the controller is worth";
  table.header = {"without",
                  "sum at 0.001, 0.01, 0.1, 1 rad",
                  "overshoot (mrad)",
                  "torque at rest (N.m)",
                  "cells lost",
                  "wrongly configured: off",
                  "worst (mrad)",
                  "their overshoot (mrad)",
                  "random: 95 % (mrad)",
                  "unknown load: 95 % (mrad)",
                  "stream, first (urad)",
                  "sixth (urad)",
                  "worth"};
  for (const AblationRow& row : rows) {
    std::string sums;
    for (const double sum : row.step_sums) sums += (sums.empty() ? "" : ", ") + number(sum, 3);
    const double share = worth(row, rows.front());
    table.rows.push_back({std::string(name_of(row.without)), sums, number(1e3 * row.overshoot_rad, 2),
                          number(row.rest_torque_Nm, 3), number(row.unsettled, 4), number(row.wrong_off, 4),
                          number(1e3 * row.wrong_worst_rad, 2), number(1e3 * row.wrong_overshoot_rad, 3),
                          number(1e3 * row.random_rest_rad, 3), number(1e3 * row.load_rest_rad, 3),
                          number(1e6 * row.first_rms_rad, 3), number(1e6 * row.sixth_rms_rad, 3),
                          row.without == Mechanism::kNone ? "" : number(100.0 * share, 3) + " %"});
  }
  return table;
}

}  // namespace strainwave
