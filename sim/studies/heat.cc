// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/heat.h"

#include <cmath>
#include <functional>
#include <limits>

#include "base/input_error.h"
#include "base/parallel.h"

namespace strainwave {

namespace {

/// One way in which the controller gets the temperature.
struct Sensing {
  std::string name;
  double lag_s;
  std::function<double(double sensor_C)> told_C;
};

/// Gives the inner controller another temperature than the sensor's.
class ToldTemperature final : public LoopController {
 public:
  ToldTemperature(LoopController& inner, const Sensing& sensing) : inner_(inner), sensing_(sensing) {}
  double torque_Nm(const LoopSample& sample) noexcept override {
    LoopSample told = sample;
    told.temperature_C = told_C_ = sensing_.told_C(sample.temperature_C);
    return inner_.torque_Nm(told);
  }
  void reset() noexcept override { inner_.reset(); }
  double told_C() const { return told_C_; }

 private:
  LoopController& inner_;
  const Sensing& sensing_;
  double told_C_ = 0.0;
};

std::vector<Sensing> sensings(const HeatConfig& config) {
  const auto exact = [](double sensor_C) { return sensor_C; };
  const auto shifted = [](double bias_C) { return [bias_C](double sensor_C) { return sensor_C + bias_C; }; };
  const double ambient_temperature_C = config.ambient_temperature_C;
  return {{"exact", 0.0, exact},
          {"lag " + number(config.sensor_lag_s) + " s", config.sensor_lag_s, exact},
          {"+" + number(config.bias_C) + " degC", 0.0, shifted(config.bias_C)},
          {"-" + number(config.bias_C) + " degC", 0.0, shifted(-config.bias_C)},
          {"ambient only", 0.0, [ambient_temperature_C](double) { return ambient_temperature_C; }},
          {"none", 0.0, [](double) { return std::numeric_limits<double>::quiet_NaN(); }}};
}

constexpr int kWindows = 100;

/// Sums of one run, folded into windows.
class HeatRecorder {
 public:
  HeatRecorder(const HeatConfig& config, HeatRun& run) : config_(config), run_(run) {}

  void add(const TracePoint& point, double told_C) {
    const double error_rad = std::abs(point.setpoint_position_rad - point.link_position_rad);
    sum_ += error_rad / config_.stroke_rad;
    const double move = std::floor((point.time_s + config_.plant.period_s) / config_.interval_s + 1e-9);
    if (move != move_) {
      ++moves_;
      settled_ += error_rad;
      move_ = move;
    }
    const double window_s = config_.duration_s / kWindows;
    if (point.time_s + config_.plant.period_s >=
            window_s * static_cast<double>(run_.pi2_over_time.size() + 1) - 1e-9 &&
        moves_ > 0)
      close_window(point, told_C);
  }
  void finish() {
    run_.mean_pi2 = total_ / total_moves_;
    run_.mean_settled_error_rad = total_settled_ / total_moves_;
  }

 private:
  void close_window(const TracePoint& point, double told_C) {
    run_.pi2_over_time.emplace_back(point.time_s, sum_ / moves_);
    run_.settled_error_over_time.emplace_back(point.time_s, settled_ / moves_);
    run_.joint_temperature_C.emplace_back(point.time_s, point.joint_temperature_C);
    run_.told_temperature_C.emplace_back(point.time_s, told_C);
    total_ += sum_;
    total_settled_ += settled_;
    total_moves_ += moves_;
    sum_ = settled_ = 0.0;
    moves_ = 0;
  }

  const HeatConfig& config_;
  HeatRun& run_;
  double sum_ = 0.0, settled_ = 0.0, move_ = 0.0;
  int moves_ = 0;
  double total_ = 0.0, total_settled_ = 0.0, total_moves_ = 0.0;
};

HeatRun run_one(const HeatConfig& config, const GainTable& table, const Sensing& sensing) {
  ClosedLoopConfig loop;
  loop.plant = config.plant;
  loop.plant.thermal.sensor_time_constant_s = sensing.lag_s;
  loop.ambient = TemperatureProfile::constant(config.ambient_temperature_C);
  loop.setpoint_rad =
      TimeProfile::square(config.stroke_rad, 0.0, config.interval_s, {"setpoint_position_rad"});
  loop.duration_s = config.duration_s;
  const auto controller = extended_contender(sensing.name, table).make(loop.plant);
  ToldTemperature told(*controller, sensing);
  HeatRun run;
  run.name = sensing.name;
  HeatRecorder recorder(config, run);
  if (!simulate(loop, told, [&](const TracePoint& point) { recorder.add(point, told.told_C()); }))
    throw InputError("heat: the loop is unstable on this plant with this table (" + sensing.name + ")");
  recorder.finish();
  return run;
}

}  // namespace

std::vector<HeatRun> run_heat(const HeatConfig& config, const GainTable& table) {
  if (!(config.duration_s >= kWindows * config.interval_s))
    throw InputError("heat", "duration_s", number(config.duration_s), "must be at least 100 intervals");
  if (!(config.stroke_rad > 0.0))
    throw InputError("heat", "stroke_rad", number(config.stroke_rad), "must be > 0");
  const auto ways = sensings(config);
  std::vector<HeatRun> runs(ways.size());
  run_in_parallel(ways.size(), [&](std::size_t i) { runs[i] = run_one(config, table, ways[i]); });
  return runs;
}

TextTable heat_summary(const std::vector<HeatRun>& runs) {
  TextTable table;
  table.title = "What the controller knows of the temperature, and what it costs";
  table.header = {"temperature", "mean PI2 per move", "relative to exact",
                  "mean |error| at the end of a move (urad)", "joint at the end (degC)"};
  for (const HeatRun& run : runs)
    table.rows.push_back({run.name, number(run.mean_pi2), number(run.mean_pi2 / runs.front().mean_pi2),
                          number(1e6 * run.mean_settled_error_rad, 3),
                          number(run.joint_temperature_C.back().second, 3)});
  return table;
}

Figure heat_figure(const std::vector<HeatRun>& runs) {
  Panel temperature{"Temperature", "time (s)", "temperature (°C)", "", {}, false, {}, {}, true};
  Panel cost{"PI2 of a move", "time (s)", "sum |e| / stroke", "", {}, false, {}, {}, true};
  Panel settled{"|error| at the end of a move", "time (s)", "rad", "", {}, true, {}, {}, true};
  temperature.series.push_back({"joint", runs.front().joint_temperature_C, Mark::kLine, 0, false});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const int colour = static_cast<int>(i) + 1;
    if (i > 0 && i + 1 < runs.size())
      temperature.series.push_back(
          {"told: " + runs[i].name, runs[i].told_temperature_C, Mark::kDashed, colour, false});
    cost.series.push_back({runs[i].name, runs[i].pi2_over_time, Mark::kLine, colour, false});
    Points errors = runs[i].settled_error_over_time;
    for (auto& [time_s, error_rad] : errors) error_rad = std::max(error_rad, 1e-9);
    settled.series.push_back({runs[i].name, errors, Mark::kLine, colour, false});
  }
  return {"heat", "A joint that works warms; what it costs not to know.", 3, {temperature, cost, settled}};
}

}  // namespace strainwave
