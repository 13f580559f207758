// The daemon's controller by default or declared rigid, on a joint that need not be what table and configuration say, and what a stranger
// sees of it: when the torque reverses, and what the monitor does. The joint is tests/support/two_mass_joint.h.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "control/joint_controller.h"
#include "tests/support/scaled_table.h"
#include "tests/support/two_mass_joint.h"

namespace strainwave::testing {

inline constexpr double kLimit_Nm = 34.0;
inline constexpr double kStrong_Nm = 4.0;

/// The catalogue's table for another inertia.
inline GainTable table_for(double inertia_kgm2) {
  return scaled_table("c4.json", inertia_kgm2);
}

inline JointControllerConfig config_for(bool rigid, double count_rad) {
  JointControllerConfig config;
  config.encoder_resolution_rad = count_rad;
  config.delay_periods = 1;
  config.torque_limit_Nm = kLimit_Nm;
  config.motor = {kLimit_Nm, 150.0, 18.3};
  config.motion = {5.0, 60.0, 60.0};
  config.rigid = rigid;
  config.use_observer = rigid;
  config.use_landing = rigid;
  return config;
}

/// Seeded.
class Draw {
 public:
  explicit Draw(unsigned seed) : random_(seed) {}
  double between(double low, double high) { return low + (high - low) * share_(random_); }
  double in_proportion(double low, double high) { return low * std::pow(high / low, share_(random_)); }

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> share_;
};

struct Outcome {
  int first_motion = -1;  ///< periods
  int fallback = -1;
  int fault = -1;
  int last_reversal = -1;         ///< of the torque, beyond what the law's friction compensation makes
  int reversals = 0;              ///< of the same
  double fallback_step_Nm = 0.0;  ///< of the torque, in the period that begins with the law alone
  double motor_rad = 0.0;
};

/// Runs as the daemon would: from the fault on there is no torque.
inline Outcome run(const TwoMassData& data, const GainTable& table, bool rigid,
                   const std::vector<double>& targets, int periods_each, double temperature_C = 20.0) {
  TwoMassJoint joint(data);
  JointController controller(config_for(rigid, joint.count_rad()));
  controller.load(table);
  controller.start(joint.reading_rad());
  Outcome outcome;
  double side = 0.0;
  double last_Nm = 0.0;
  int now = 0;
  for (const double target_rad : targets) {
    controller.set_target(target_rad);
    for (int k = 0; k < periods_each; ++k, ++now) {
      JointMeasurement measurement;
      measurement.joint_position_rad = joint.reading_rad();
      measurement.temperature_C = temperature_C;
      measurement.temperature_valid = true;
      const JointStep step = controller.step(measurement);
      const double torque_Nm = outcome.fault < 0 ? step.output.torque_Nm : 0.0;
      if (outcome.fallback == now - 1 && outcome.fallback >= 0)
        outcome.fallback_step_Nm = torque_Nm - last_Nm;
      if (step.monitor != MonitorState::kWatching && outcome.fallback < 0) outcome.fallback = now;
      if (step.monitor == MonitorState::kFaultDue && outcome.fault < 0) outcome.fault = now;
      if (std::abs(torque_Nm) > kStrong_Nm) {
        if (side * torque_Nm < 0.0) {
          ++outcome.reversals;
          outcome.last_reversal = now;
        }
        side = torque_Nm;
      }
      last_Nm = torque_Nm;
      joint.step(torque_Nm);
      if (joint.moves() && outcome.first_motion < 0) outcome.first_motion = now;
    }
  }
  outcome.motor_rad = joint.motor_rad();
  return outcome;
}

}  // namespace strainwave::testing
