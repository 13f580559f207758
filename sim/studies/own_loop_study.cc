// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/own_loop_study.h"

#include <cmath>
#include <memory>
#include <optional>

#include "base/parallel.h"
#include "sim/studies/path_follower.h"
#include "sim/studies/peers/cascade.h"

namespace strainwave {

namespace {

constexpr double kBusPeriod_s = 1e-3;
constexpr std::array<const char*, 4> kNames = {"alone", "plan", "wind-up", "all offsets"};
/// Additional delay that a drive with a margin is tuned for.
constexpr double kMargin_periods = 1.0;

JointPlantConfig plant_at(double rate_Hz) {
  JointPlantConfig plant = temperature_plant();
  plant.period_s = 1.0 / rate_Hz;
  return plant;
}

JointControllerConfig controller_config(JointPlantConfig plant, const GainTable& table, Told told) {
  const double drive_period_s = plant.period_s;
  plant.period_s = kBusPeriod_s;
  JointControllerConfig config = extended_config(plant, table);
  config.drive_loop_period_s = drive_period_s;
  config.delay_periods = 1;
  config.drive_mode = DriveMode::kPosition;
  if (told == Told::kPlan) config.without = Mechanism::kWindUp;
  return config;
}

ServoJoint tuned_joint(const JointPlantConfig& plant, double margin_periods) {
  ServoJoint joint = servo_joint(plant);
  joint.delay_periods += margin_periods;
  return joint;
}

/// The daemon, the bus, the drive's interpolation and its cascade. An order acts in the bus period that
/// begins one period after its reading. The drive reaches its position at the end of that period.
class OwnLoop final : public LoopController {
 public:
  OwnLoop(const JointPlantConfig& plant, const GainTable& table, const SmoothPath& path, Told told,
          double margin_periods)
      : told_(told),
        path_(path),
        steps_(static_cast<int>(std::lround(kBusPeriod_s / plant.period_s))),
        daemon_(controller_config(plant, table, told), table, path, {}),
        cascade_(tuned_joint(plant, margin_periods), true) {}

  double torque_Nm(const LoopSample& sample) noexcept override {
    if (tick_ == 0) {
      cascade_.reset(sample.joint_position_rad);
      acting_ = pending_ = {{sample.joint_position_rad, 0.0}, 0.0};
    }
    if (tick_ % steps_ == 0) take_order(sample);
    const double share = static_cast<double>(tick_ % steps_) / steps_;
    ++tick_;
    torque_sum_Nm_ += sample.torque_applied_Nm;
    const double place_rad = from_rad_ + share * (acting_.motor.position_rad - from_rad_);
    return cascade_.step({place_rad, acting_.motor.velocity_rad_s, 0.0}, sample.joint_position_rad) +
           acting_.torque_Nm;
  }
  void reset() noexcept override {
    daemon_.reset();
    tick_ = 0;
  }

 private:
  struct Sent {
    MotorOrder motor;
    double torque_Nm = 0.0;
  };

  void take_order(const LoopSample& sample) noexcept {
    from_rad_ = acting_.motor.position_rad;
    acting_ = pending_;
    if (told_ == Told::kNothing) {
      pending_ = {{path_.at(sample.time_s + 2.0 * kBusPeriod_s).position_rad, 0.0}, 0.0};
      return;
    }
    LoopSample seen = sample;
    seen.torque_applied_Nm = torque_sum_Nm_ / steps_;
    torque_sum_Nm_ = 0.0;
    const JointStep step = daemon_.step(seen);
    pending_ = {step.order, told_ == Told::kAllOffsets ? step.output.torque_Nm : 0.0};
  }

  Told told_;
  SmoothPath path_;
  int steps_;
  StreamedController daemon_;
  CascadePeer cascade_;
  Sent acting_;   ///< order until the next SYNC
  Sent pending_;  ///< order from the next SYNC on
  double from_rad_ = 0.0;
  double torque_sum_Nm_ = 0.0;  ///< since the last SYNC; the drive reports the mean
  long tick_ = 0;
};

double mean_rms_rad(const JointPlantConfig& plant, const FrictionWay& way, double temperature_C) {
  double sum = 0.0;
  const std::vector<PathMotion> motions = study_motions();
  for (const PathMotion& motion : motions)
    sum += std::log(
        run_path(plant, way, motion.path, sensor_faults().front(), temperature_C, {motion.path.end_s()})
            .stretches.back()
            .rms_rad);
  return std::exp(sum / static_cast<double>(motions.size()));
}

}  // namespace

FrictionWay own_loop_way(const GainTable& table, Told told, double margin_periods) {
  std::string name = kNames[static_cast<std::size_t>(told)];
  if (margin_periods > 0.0) name += ", margin";
  return {name, [table, told, margin_periods](const JointPlantConfig& plant, const SmoothPath& path, double) {
            return std::make_unique<OwnLoop>(plant, table, path, told, margin_periods);
          }};
}

std::vector<OwnLoopRow> run_own_loops(const FlexibleTables& tables) {
  const GainTable& table = study_table(tables);
  std::vector<FrictionWay> ways{friction_ways(tables).back()};
  ways.front().name = "torque mode";
  for (const Told told : {Told::kNothing, Told::kPlan, Told::kWindUp, Told::kAllOffsets})
    ways.push_back(own_loop_way(table, told));
  ways.push_back(own_loop_way(table, Told::kAllOffsets, kMargin_periods));
  struct Job {
    const FrictionWay* way;
    OwnLoopRow row;
  };
  std::vector<Job> jobs;
  for (const double temperature_C : kOwnLoopTemperatures_C)
    for (const FrictionWay& way : ways)
      for (const double rate_Hz : kDriveRates_Hz)
        // Faster drives are tuned by the joint's resonance, which the margin does not change. The torque mode needs the table's period.
        if ((&way != &ways.front() && &way != &ways.back()) || rate_Hz == kDriveRates_Hz.front())
          jobs.push_back({&way, {way.name, rate_Hz, temperature_C, 0.0, 0.0}});
  run_in_parallel(jobs.size(), [&](std::size_t i) {
    OwnLoopRow& row = jobs[i].row;
    row.rms_rad = mean_rms_rad(plant_at(row.rate_Hz), *jobs[i].way, row.temperature_C);
  });
  std::vector<OwnLoopRow> rows;
  double torque_mode_rad = 0.0;
  for (Job& job : jobs) {
    if (job.way == &ways.front()) torque_mode_rad = job.row.rms_rad;
    job.row.over_torque_mode = job.row.rms_rad / torque_mode_rad;
    rows.push_back(job.row);
  }
  return rows;
}

}  // namespace strainwave
