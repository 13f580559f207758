// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/flexible_study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <tuple>

#include "base/input_error.h"
#include "base/parallel.h"
#include "base/units.h"
#include "control/table/gain_table_json.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/link_limit.h"

namespace strainwave {

namespace {

constexpr double kRestShare = 0.25;

double total_inertia(const JointPlantConfig& plant) {
  return plant.joint.inertia_kgm2 +
         (plant.effects.transmission ? plant.effects.transmission->link_inertia_kgm2 : 0.0);
}

ClosedLoopConfig loop_of(const FlexibleCell& cell) {
  ClosedLoopConfig config;
  config.plant = cell.plant;
  config.ambient = TemperatureProfile::constant(cell.temperature_C);
  config.setpoint_rad = TimeProfile::constant(cell.step_rad, {"setpoint_position_rad"});
  config.duration_s = cell.duration_s;
  return config;
}

struct Limit {
  double pi2 = 0.0;
  double counted_pi2 = 0.0;
};

/// Cells that differ only in damping share a limit, since damping hardly changes it.
using LimitKey = std::tuple<double, double, double, double, double>;

LimitKey key_of(const FlexibleCell& cell) {
  return {cell.link_inertia_kgm2, cell.nominal.effects.transmission->spring.stiffness_3_Nm_rad,
          cell.temperature_C, cell.step_rad, cell.nominal.delay.periods};
}

std::map<LimitKey, Limit> limits_of(const std::vector<FlexibleCell>& cells) {
  std::map<LimitKey, Limit> limits;
  std::vector<const FlexibleCell*> distinct;
  for (const FlexibleCell& cell : cells)
    if (limits.try_emplace(key_of(cell)).second) distinct.push_back(&cell);
  run_in_parallel(distinct.size(), [&](std::size_t i) {
    const FlexibleCell& cell = *distinct[i];
    const LinkLimit limit =
        find_link_limit(link_limit_config(cell.nominal, cell.temperature_C, cell.step_rad));
    limits.at(key_of(cell)) = {limit.pi2, limit.counted_pi2};
  });
  return limits;
}

/// Sums of one side of the gear.
struct SideSums {
  double all = 0.0;
  double counted = 0.0;
  void add(double error_rad, double step_rad) {
    const double share = std::abs(error_rad / step_rad);
    all += share;
    if (std::abs(error_rad) > kCountedError_rad) counted += share;
  }
};

void add_rest(const std::vector<TracePoint>& trace, double step_rad, double period_s,
              FlexibleResult& result) {
  const auto count = static_cast<std::size_t>(kRestShare * static_cast<double>(trace.size()));
  double low = 1e300;
  double high = -1e300;
  double squares = 0.0;
  double last_sign = 0.0;
  int changes = 0;
  for (auto point = trace.end() - static_cast<std::ptrdiff_t>(count); point != trace.end(); ++point) {
    low = std::min(low, point->link_position_rad);
    high = std::max(high, point->link_position_rad);
    result.rest_error_rad = std::max(result.rest_error_rad, std::abs(step_rad - point->link_position_rad));
    squares += point->applied_torque_Nm * point->applied_torque_Nm;
    result.rest_peak_Nm = std::max(result.rest_peak_Nm, std::abs(point->applied_torque_Nm));
    const double torque_sign = sign(point->applied_torque_Nm);
    if (torque_sign * last_sign < 0.0) ++changes;
    if (torque_sign != 0.0) last_sign = torque_sign;
  }
  result.rest_rms_Nm = std::sqrt(squares / static_cast<double>(count));
  result.rest_sign_changes_per_s = changes / (static_cast<double>(count) * period_s);
  result.rest_swing_rad = high - low;
  result.oscillates =
      result.rest_swing_rad > kOscillation_rad && result.rest_sign_changes_per_s > kOscillationSignChanges_Hz;
}

FlexibleResult judge(const FlexibleCell& cell, const ClosedLoopResult& run, const Limit& limit) {
  FlexibleResult result;
  result.diverged = run.diverged;
  result.switched_off = run.switched_off_s.has_value();
  SideSums link;
  SideSums motor;
  const double direction = sign(cell.step_rad);
  double settled_s = 0.0;
  for (const TracePoint& point : run.trace) {
    const double error_rad = cell.step_rad - point.link_position_rad;
    link.add(error_rad, cell.step_rad);
    motor.add(cell.step_rad - point.joint_position_rad, cell.step_rad);
    result.overshoot_rad = std::max(result.overshoot_rad, -direction * error_rad);
    if (std::abs(error_rad) > kCountedError_rad) settled_s = point.time_s + cell.plant.period_s;
  }
  if (!run.trace.empty() && settled_s <= run.trace.back().time_s) result.settling_time_s = settled_s;
  result.link_ratio = link.all / limit.pi2;
  result.motor_ratio = motor.all / limit.pi2;
  result.link_counted_ratio = link.counted / limit.counted_pi2;
  result.motor_counted_ratio = motor.counted / limit.counted_pi2;
  if (run.diverged) {
    result.oscillates = true;
    result.link_ratio = result.link_counted_ratio = std::numeric_limits<double>::infinity();
    return result;
  }
  add_rest(run.trace, cell.step_rad, cell.plant.period_s, result);
  if (result.oscillates) result.settling_time_s = -1.0;  // within two counts at the end only by chance
  return result;
}

}  // namespace

const GainTable& FlexibleTables::nearest(const std::vector<GainTable>& tables, double total_kgm2) {
  return *std::min_element(tables.begin(), tables.end(), [&](const GainTable& a, const GainTable& b) {
    return std::abs(std::log(a.plant.inertia_kgm2 / total_kgm2)) <
           std::abs(std::log(b.plant.inertia_kgm2 / total_kgm2));
  });
}

FlexibleTables read_flexible_tables(const std::filesystem::path& directory) {
  FlexibleTables tables;
  tables.shipped = read_gain_table(directory / "csf-17-50.json");
  tables.shipped_for_delays = read_gain_table(directory / "csf-17-50-delays.json");
  for (const char* total : {"total-0.119", "total-0.178", "total-0.356", "total-1.089"}) {
    tables.c1.push_back(read_gain_table(directory / total / "c1.json"));
    tables.c2.push_back(read_gain_table(directory / total / "c2.json"));
    tables.c3.push_back(read_gain_table(directory / total / "c3.json"));
    tables.c4.push_back(read_gain_table(directory / total / "c4.json"));
  }
  return tables;
}

Contender daemon_contender(const FlexibleTables& tables, Mechanism without) {
  return extended_contender("daemon", tables.shipped, kNoMotionLimits, without);
}

std::vector<Contender> flexible_contenders(const FlexibleTables& tables, bool all) {
  using Make = Contender (*)(const std::string&, const GainTable&);
  const auto plain = [&](const std::string& name, const std::vector<GainTable>& family, Make make) {
    return Contender{name, [name, family, make](const JointPlantConfig& plant) {
                       return make(name, FlexibleTables::nearest(family, total_inertia(plant))).make(plant);
                     }};
  };
  std::vector<Contender> contenders = {pid_contender(), plain("C4", tables.c4, &plain_contender),
                                       daemon_contender(tables)};
  if (!all) return contenders;
  contenders.push_back(plain("C1", tables.c1, &plain_contender));
  contenders.push_back(plain("C2", tables.c2, &plain_contender));
  contenders.push_back(plain("C3", tables.c3, &plain_contender));
  return contenders;
}

ClosedLoopResult run_cell(const FlexibleCell& cell, const Contender& contender) {
  const auto controller = contender.make(cell.nominal);
  return run_closed_loop(loop_of(cell), *controller);
}

FlexibleResult run_without_limit(const FlexibleCell& cell, const Contender& contender) {
  return judge(cell, run_cell(cell, contender), {1.0, 1.0});
}

bool oscillates(const FlexibleCell& cell, const Contender& contender) {
  return run_without_limit(cell, contender).oscillates;
}

std::vector<FlexibleRow> run_flexible(const std::vector<FlexibleCell>& cells,
                                      const std::vector<Contender>& contenders,
                                      const std::function<void(std::size_t)>& progress) {
  const std::map<LimitKey, Limit> limits = limits_of(cells);
  std::vector<FlexibleRow> rows(cells.size());
  std::mutex reporting;
  std::size_t done = 0;
  run_in_parallel(cells.size(), [&](std::size_t i) {
    const Limit& limit = limits.at(key_of(cells[i]));
    rows[i].cell = cells[i];
    rows[i].limit_pi2 = limit.pi2;
    for (const Contender& contender : contenders)
      rows[i].results.push_back(judge(cells[i], run_cell(cells[i], contender), limit));
    const std::scoped_lock lock(reporting);
    progress(++done);
  });
  return rows;
}

}  // namespace strainwave
