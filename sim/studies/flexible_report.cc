#include "sim/studies/flexible_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace strainwave {

namespace {

// PID, C4, the daemon's controller, told of its spring, and with every part on: more lines are not told apart.
constexpr std::size_t kDrawnContenders = 5;

double percentile(std::vector<double> values, double fraction) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(std::lround(fraction * static_cast<double>(values.size() - 1)))];
}

double geometric_mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += std::log(value);
  return values.empty() ? 0.0 : std::exp(sum / static_cast<double>(values.size()));
}

template <typename Value>
std::vector<double> values_of(const std::vector<FlexibleRow>& rows, std::size_t contender,
                              const Value& value) {
  std::vector<double> values;
  values.reserve(rows.size());
  for (const FlexibleRow& row : rows) values.push_back(value(row.results[contender]));
  return values;
}

double free_free_Hz(const FlexibleCell& cell) {
  const Transmission& gear = *cell.plant.effects.transmission;
  return free_free_frequency_rad_s(cell.plant.joint.inertia_kgm2, gear.link_inertia_kgm2,
                                   gear.spring.stiffness_1_Nm_rad) /
         (2.0 * std::numbers::pi);
}

Panel panel(const std::string& title, const std::string& x, const std::string& y, bool log_y) {
  return {title, x, y, "", {}, log_y, {}, {}, true};
}

/// Amplitude of `values` over frequency, by the definition of the transform: the stretches are short.
Points spectrum(const std::vector<double>& values, double period_s) {
  Points points;
  const std::size_t count = values.size();
  for (std::size_t f = 1; f < count / 2; ++f) {
    double cosine = 0.0;
    double sine = 0.0;
    const double angle = 2.0 * std::numbers::pi * static_cast<double>(f) / static_cast<double>(count);
    for (std::size_t k = 0; k < count; ++k) {
      cosine += values[k] * std::cos(angle * static_cast<double>(k));
      sine += values[k] * std::sin(angle * static_cast<double>(k));
    }
    points.emplace_back(static_cast<double>(f) / (static_cast<double>(count) * period_s),
                        1e-6 + 2.0 / static_cast<double>(count) * std::hypot(cosine, sine));
  }
  return points;
}

/// The cell of the middle joint with the heavy link, cold, of this step.
const FlexibleRow* example(const std::vector<FlexibleRow>& rows, double step_rad) {
  const FlexibleRow* found = nullptr;
  for (const FlexibleRow& row : rows)
    if (row.cell.step_rad == step_rad && row.cell.temperature_C == -10.0 &&
        row.cell.link_inertia_kgm2 < 0.5 &&
        (found == nullptr || row.cell.link_inertia_kgm2 >= found->cell.link_inertia_kgm2))
      found = &row;
  return found;
}

const char* monitor_word(MonitorState state) {
  switch (state) {
    case MonitorState::kWatching:
      return "watches";
    case MonitorState::kFallenBack:
      return "fallen back";
    case MonitorState::kFaultDue:
      return "switched off";
  }
  return "";
}

/// Where a cell stands on the map: each step has a band, in it the temperatures rise, and in those the damping.
double map_height(const FlexibleCell& cell) {
  const double temperature = (cell.temperature_C + 10.0) / 55.0;
  const double damping = std::log10(cell.damping_ratio / 0.01);
  return cell.step_rad * std::pow(10.0, 0.6 * (temperature - 0.5) + 0.1 * (damping - 0.5));
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
                  "monitor",
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
      fields.emplace_back(monitor_word(r.monitor));
      fields.emplace_back(r.diverged ? "yes" : "no");
      table.rows.push_back(fields);
    }
  return table;
}

TextTable flexible_summary(const std::string& title, const std::vector<FlexibleRow>& rows,
                           const std::vector<Contender>& contenders) {
  TextTable table;
  table.title = title + ", " + std::to_string(rows.size()) + " cells";
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
                  "fallen back",
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
    table.rows.push_back(
        {contenders[c].name, number(geometric_mean(all), 3), number(percentile(all, 0.95), 3),
         number(percentile(all, 1.0), 3), number(geometric_mean(counted), 3),
         number(percentile(counted, 0.95), 3),
         count([](const FlexibleResult& r) { return r.settling_time_s >= 0.0; }),
         number(percentile(overshoot, 1.0), 3), number(percentile(rest, 0.95), 3),
         count([](const FlexibleResult& r) { return r.oscillates; }),
         count([](const FlexibleResult& r) { return r.monitor == MonitorState::kFallenBack; }),
         count([](const FlexibleResult& r) { return r.monitor == MonitorState::kFaultDue; }),
         count([](const FlexibleResult& r) { return r.diverged; })});
  }
  return table;
}

TextTable oscillation_table(const std::string& title, const std::vector<FlexibleRow>& rows,
                            const std::vector<Contender>& contenders) {
  std::set<double> inertias;
  for (const FlexibleRow& row : rows) inertias.insert(row.cell.link_inertia_kgm2);
  TextTable table;
  table.title = title;
  table.header = {"controller"};
  for (const double inertia : inertias) table.header.push_back("link " + number(inertia, 3) + " kg.m2");
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    std::vector<std::string> fields = {contenders[c].name};
    for (const double inertia : inertias) {
      int cells = 0;
      int oscillating = 0;
      for (const FlexibleRow& row : rows) {
        if (row.cell.link_inertia_kgm2 != inertia) continue;
        ++cells;
        oscillating += row.results[c].oscillates ? 1 : 0;
      }
      fields.push_back(std::to_string(oscillating) + " of " + std::to_string(cells));
    }
    table.rows.push_back(fields);
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
      // A run that diverged counts as far off, not as infinitely far.
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

std::vector<Figure> flexible_figures(const std::vector<FlexibleRow>& rows,
                                     const std::vector<Contender>& contenders) {
  const std::size_t drawn = std::min(contenders.size(), kDrawnContenders);
  Figure responses{"flexible_responses",
                   "The link's error over time, -10 degC, the heaviest link below 0.5 kg.m2.",
                   2,
                   {}};
  Panel torque = panel("torque at rest after 0.1 rad", "frequency (Hz)", "amplitude (N.m)", true);
  for (const double step_rad : {0.001, 0.01, 0.1, 1.0}) {
    const FlexibleRow* row = example(rows, step_rad);
    if (row == nullptr) continue;
    Panel response = panel(number(step_rad) + " rad", "time (s)", "link's error / step", false);
    for (std::size_t c = 0; c < drawn; ++c) {
      const ClosedLoopResult run = run_cell(row->cell, contenders[c]);
      const int colour = static_cast<int>(c) + 1;
      Points points;
      std::vector<double> rest;
      for (const TracePoint& point : run.trace) {
        if (point.time_s <= 0.6)
          points.emplace_back(point.time_s, (step_rad - point.link_position_rad) / step_rad);
        if (point.time_s >= 1.5) rest.push_back(point.applied_torque_Nm);
      }
      response.series.push_back({contenders[c].name, thinned(points), Mark::kLine, colour, false});
      if (step_rad == 0.1)
        torque.series.push_back(
            {contenders[c].name, spectrum(rest, row->cell.plant.period_s), Mark::kLine, colour, false});
    }
    responses.panels.push_back(response);
  }
  Figure map{"flexible_map",
             "Where the joint oscillates at rest, or the monitor took over, over its free-free frequency. "
             "Each step has a band; "
             "in it temperature rises from -10 to 45 degC, and for each temperature damping from 1 to 10 %.",
             2,
             {}};
  for (std::size_t c = 0; c < drawn; ++c) {
    Panel where = panel(contenders[c].name, "free-free frequency (Hz)", "step (rad)", true);
    where.y_range = {3e-4, 3.0};
    Points quiet;
    Points fallen;
    Points off;
    Points loud;
    for (const FlexibleRow& row : rows) {
      const FlexibleResult& result = row.results[c];
      Points& kind = result.oscillates                             ? loud
                     : result.monitor == MonitorState::kFaultDue   ? off
                     : result.monitor == MonitorState::kFallenBack ? fallen
                                                                   : quiet;
      kind.emplace_back(free_free_Hz(row.cell), map_height(row.cell));
    }
    const auto add = [&](const char* name, const Points& points, int colour) {
      if (!points.empty()) where.series.push_back({name, points, Mark::kPoints, colour, false});
    };
    add("quiet", quiet, 7);
    add("fallen back", fallen, 2);
    add("switched off", off, 6);
    add("oscillating", loud, 5);
    map.panels.push_back(where);
  }
  return {
      responses, {"flexible_spectrum", "The torque's spectrum over the last half second.", 1, {torque}}, map};
}

}  // namespace strainwave
