// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/robustness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "base/input_error.h"
#include "base/parallel.h"
#include "base/printable.h"
#include "sim/studies/link_limit.h"
#include "sim/studies/statistics.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

namespace {

void require(bool valid, const char* key, double value, const char* allowed) {
  if (!valid) throw InputError("robustness", key, number(value), allowed);
}

void check(const RobustnessConfig& c) {
  require(c.draws >= 1 && c.draws <= 100000, "draws", c.draws, "must be in 1..100000");
  require(c.inertia_spread >= 0.0 && c.inertia_spread < 1.0, "inertia_spread", c.inertia_spread,
          "must be in [0, 1)");
  require(c.friction_spread >= 0.0 && c.friction_spread < 1.0, "friction_spread", c.friction_spread,
          "must be in [0, 1)");
  require(c.payload_inertia_kgm2 >= 0.0, "payload_inertia_kgm2", c.payload_inertia_kgm2, "must be >= 0");
  require(c.payload_torque_Nm >= 0.0, "payload_torque_Nm", c.payload_torque_Nm, "must be >= 0");
  require(c.temperature_min_C <= c.temperature_max_C, "temperature_min_C", c.temperature_min_C,
          "must not exceed temperature_max_C");
  require(c.setpoint_rad != 0.0 && std::isfinite(c.setpoint_rad), "setpoint_rad", c.setpoint_rad,
          "must be finite and not 0");
}

FrictionParameters scaled(const FrictionParameters& friction, double factor) {
  return {factor * friction.static_Nm, factor * friction.coulomb_Nm, factor * friction.viscous_Nms_rad};
}

/// Closed-loop configuration of one draw; fills in what was drawn.
ClosedLoopConfig drawn_config(const RobustnessConfig& config, std::size_t index, RobustnessDraw& draw) {
  std::seed_seq seed{config.seed, static_cast<std::uint64_t>(index)};
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    // The results of standard distributions depend on the library; this formula gives the same draw everywhere.
    return low + (high - low) * std::ldexp(static_cast<double>(random() >> 11U), -53);
  };
  ClosedLoopConfig result;
  result.plant = config.plant;
  // The inertia that the joint carries varies: the link of a flexible joint, all of a rigid one.
  auto& transmission = result.plant.effects.transmission;
  double& varied_kgm2 = transmission ? transmission->link_inertia_kgm2 : result.plant.joint.inertia_kgm2;
  varied_kgm2 = varied_kgm2 * uniform(1.0 - config.inertia_spread, 1.0 + config.inertia_spread) +
                uniform(0.0, config.payload_inertia_kgm2);
  draw.inertia_kgm2 = varied_kgm2 + (transmission ? result.plant.joint.inertia_kgm2 : 0.0);
  draw.friction_factor = uniform(1.0 - config.friction_spread, 1.0 + config.friction_spread);
  draw.load_torque_Nm = uniform(-config.payload_torque_Nm, config.payload_torque_Nm);
  draw.temperature_C = uniform(config.temperature_min_C, config.temperature_max_C);
  ExponentialTemperatureLaw& friction = result.plant.joint.friction;
  friction.asymptote = scaled(friction.asymptote, draw.friction_factor);
  friction.amplitude = scaled(friction.amplitude, draw.friction_factor);
  result.ambient = TemperatureProfile::constant(draw.temperature_C);
  result.load_torque_Nm = TimeProfile::constant(draw.load_torque_Nm, {"load_torque_Nm"});
  result.setpoint_rad = TimeProfile::constant(config.setpoint_rad, {"setpoint_position_rad"});
  result.duration_s = config.duration_s;
  return result;
}

template <typename Value>
std::vector<double> values_of(const std::vector<RobustnessDraw>& draws, const Value& value) {
  std::vector<double> values;
  values.reserve(draws.size());
  for (const RobustnessDraw& draw : draws) values.push_back(value(draw));
  return values;
}

double ratio(const RobustnessDraw& draw, std::size_t contender) {
  return draw.statistics[contender].pi2 / draw.limit_pi2;
}
double final_error(const RobustnessDraw& draw, std::size_t contender) {
  return std::abs(draw.statistics[contender].final_error_rad);
}

}  // namespace

std::vector<RobustnessDraw> run_robustness(const RobustnessConfig& config,
                                           const std::vector<Contender>& contenders) {
  check(config);
  std::vector<RobustnessDraw> draws(static_cast<std::size_t>(config.draws));
  run_in_parallel(draws.size(), [&](std::size_t i) {
    RobustnessDraw& draw = draws[i];
    const ClosedLoopConfig loop = drawn_config(config, i, draw);
    draw.limit_pi2 = loop.plant.effects.transmission
                         ? find_link_limit(link_limit_config(loop.plant, draw.temperature_C,
                                                             config.setpoint_rad, draw.load_torque_Nm))
                               .pi2
                         : run_time_optimal(loop).statistics.pi2;
    for (const Contender& contender : contenders) {
      const ClosedLoopResult result = run_closed_loop(loop, *contender.make(loop.plant));
      LoopStatistics statistics = evaluate(on_the_link(result.trace), loop.plant.period_s);
      if (result.diverged) statistics.pi1_rad2 = statistics.pi2 = std::numeric_limits<double>::infinity();
      draw.statistics.push_back(statistics);
      draw.diverged.push_back(result.diverged);
    }
  });
  return draws;
}

TextTable robustness_table(const std::vector<RobustnessDraw>& draws,
                           const std::vector<Contender>& contenders) {
  TextTable table;
  table.header = {"draw", "inertia_kgm2", "friction_factor", "load_torque_Nm", "temperature_C", "limit_pi2"};
  for (const Contender& contender : contenders)
    for (const char* column : {"pi2", "final_error_rad", "overshoot_rad", "steady_sign_changes_per_s"})
      table.header.push_back(contender.name + "_" + column);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    const RobustnessDraw& d = draws[i];
    std::vector<std::string> row = {std::to_string(i)};
    for (const double value :
         {d.inertia_kgm2, d.friction_factor, d.load_torque_Nm, d.temperature_C, d.limit_pi2})
      row.push_back(number(value, 9));
    for (const LoopStatistics& s : d.statistics)
      for (const double value : {s.pi2, s.final_error_rad, s.overshoot_rad, s.steady_sign_changes_per_s})
        row.push_back(number(value, 9));
    table.rows.push_back(row);
  }
  return table;
}

TextTable robustness_summary(const std::vector<RobustnessDraw>& draws,
                             const std::vector<Contender>& contenders) {
  TextTable table;
  table.title = "Over " + counted(draws.size(), "joint");
  table.header = {"controller",
                  "PI2/limit median",
                  "95 %",
                  "worst",
                  "|final error| median (urad)",
                  "95 %",
                  "worst overshoot (urad)",
                  "torque sign changes/s, 95 %",
                  "diverged"};
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const auto ratios = values_of(draws, [&](const RobustnessDraw& d) { return ratio(d, c); });
    const auto errors = values_of(draws, [&](const RobustnessDraw& d) { return 1e6 * final_error(d, c); });
    const auto overshoots =
        values_of(draws, [&](const RobustnessDraw& d) { return 1e6 * d.statistics[c].overshoot_rad; });
    const auto changes =
        values_of(draws, [&](const RobustnessDraw& d) { return d.statistics[c].steady_sign_changes_per_s; });
    const auto diverged =
        std::count_if(draws.begin(), draws.end(), [&](const RobustnessDraw& d) { return d.diverged[c]; });
    table.rows.push_back({contenders[c].name, number(percentile(ratios, 0.5), 3),
                          number(percentile(ratios, 0.95), 3), number(percentile(ratios, 1.0), 3),
                          number(percentile(errors, 0.5), 3), number(percentile(errors, 0.95), 3),
                          number(percentile(overshoots, 1.0), 3), number(percentile(changes, 0.95), 3),
                          std::to_string(diverged)});
  }
  return table;
}

Figure robustness_figure(const std::vector<RobustnessDraw>& draws, const std::vector<Contender>& contenders) {
  Panel distribution{
      "share of joints within", "PI2 / physical limit", "share", "", {}, false, {}, {0, 1}, true};
  Panel errors{
      "share of joints within", "log10 |final error| (rad)", "share", "", {}, false, {}, {0, 1}, true};
  Panel inertia{"over inertia", "inertia (kg.m^2)", "PI2 / physical limit", "", {}, true, {}, {}, true};
  Panel friction{"over friction", "friction factor", "PI2 / physical limit", "", {}, true, {}, {}, true};
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const int colour = static_cast<int>(c) + 1;
    auto ratios = values_of(draws, [&](const RobustnessDraw& d) { return ratio(d, c); });
    auto sizes = values_of(
        draws, [&](const RobustnessDraw& d) { return std::log10(std::max(1e-9, final_error(d, c))); });
    std::sort(ratios.begin(), ratios.end());
    std::sort(sizes.begin(), sizes.end());
    Points shares;
    Points error_shares;
    Points by_inertia;
    Points by_friction;
    for (std::size_t i = 0; i < draws.size(); ++i) {
      const double share = static_cast<double>(i + 1) / static_cast<double>(draws.size());
      if (std::isfinite(ratios[i])) shares.emplace_back(ratios[i], share);
      error_shares.emplace_back(sizes[i], share);
      if (!std::isfinite(ratio(draws[i], c))) continue;
      by_inertia.emplace_back(draws[i].inertia_kgm2, ratio(draws[i], c));
      by_friction.emplace_back(draws[i].friction_factor, ratio(draws[i], c));
    }
    distribution.series.push_back({contenders[c].name, shares, Mark::kStaircase, colour, false});
    errors.series.push_back({contenders[c].name, error_shares, Mark::kStaircase, colour, false});
    inertia.series.push_back({contenders[c].name, by_inertia, Mark::kPoints, colour, false});
    friction.series.push_back({contenders[c].name, by_friction, Mark::kPoints, colour, false});
  }
  return {"robustness",
          "Joints drawn at random around the one the tables were designed for.",
          2,
          {distribution, errors, inertia, friction}};
}

}  // namespace strainwave
