// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/flexible_figures.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/studies/text_table.h"

namespace strainwave {

namespace {

// More lines could not be distinguished.
constexpr std::size_t kDrawnContenders = 5;

double free_free_Hz(const FlexibleCell& cell) {
  const Transmission& gear = *cell.plant.effects.transmission;
  return free_free_frequency_rad_s(cell.plant.joint.inertia_kgm2, gear.link_inertia_kgm2,
                                   gear.spring.stiffness_1_Nm_rad) /
         (2.0 * std::numbers::pi);
}

Panel panel(const std::string& title, const std::string& x, const std::string& y, bool log_y) {
  return {title, x, y, "", {}, log_y, {}, {}, true};
}

/// Amplitude of `values` over frequency, by the definition of the Fourier transform, since the stretches are short.
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

/// Returns the cold cell of this step with the heaviest link below 0.5 kg m2; of several such cells, the last.
const FlexibleRow* example(const std::vector<FlexibleRow>& rows, double step_rad) {
  const FlexibleRow* found = nullptr;
  for (const FlexibleRow& row : rows)
    if (row.cell.step_rad == step_rad && row.cell.temperature_C == -10.0 &&
        row.cell.link_inertia_kgm2 < 0.5 &&
        (found == nullptr || row.cell.link_inertia_kgm2 >= found->cell.link_inertia_kgm2))
      found = &row;
  return found;
}

/// Height of a cell on the map. Each step has a band; in it the temperatures rise, and at each temperature the damping.
double map_height(const FlexibleCell& cell) {
  const double temperature = (cell.temperature_C + 10.0) / 55.0;
  const double damping = std::log10(cell.damping_ratio / 0.01);
  return cell.step_rad * std::pow(10.0, 0.6 * (temperature - 0.5) + 0.1 * (damping - 0.5));
}

}  // namespace

std::vector<Figure> flexible_figures(const std::vector<FlexibleRow>& rows,
                                     const std::vector<Contender>& contenders) {
  const std::size_t drawn = std::min(contenders.size(), kDrawnContenders);
  Figure responses{
      "flexible_responses", "The link's error over time, -10 °C, the heaviest link below 0.5 kg·m².", 2, {}};
  Panel torque = panel("torque at rest after 0.1 rad", "frequency (Hz)", "amplitude (N·m)", true);
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
  Figure map{
      "flexible_map",
      "Where the joint oscillates at rest, or the controller switched it off, over its free-free frequency. "
      "Each step has a band; "
      "in it temperature rises from -10 to 45 °C, and for each temperature damping from 1 to 10 %.",
      2,
      {}};
  for (std::size_t c = 0; c < drawn; ++c) {
    Panel where = panel(contenders[c].name, "free-free frequency (Hz)", "step (rad)", true);
    where.y_range = {3e-4, 3.0};
    Points quiet;
    Points off;
    Points loud;
    for (const FlexibleRow& row : rows) {
      const FlexibleResult& result = row.results[c];
      Points& kind = result.oscillates ? loud : result.switched_off ? off : quiet;
      kind.emplace_back(free_free_Hz(row.cell), map_height(row.cell));
    }
    const auto add = [&](const char* name, const Points& points, int colour) {
      if (!points.empty()) where.series.push_back({name, points, Mark::kPoints, colour, false});
    };
    add("quiet", quiet, 7);
    add("switched off", off, 6);
    add("oscillating", loud, 5);
    map.panels.push_back(where);
  }
  return {
      responses, {"flexible_spectrum", "The torque's spectrum over the last half second.", 1, {torque}}, map};
}

}  // namespace strainwave
