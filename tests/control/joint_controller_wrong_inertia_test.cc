// The daemon's controller on joints with a spring whose table is for several times the inertia: by default, and told of a spring. What it
// does is no motion any more; that it ends, and how soon, is what is tested. The joint is tests/support/two_mass_joint.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

#include "control/gain_table_json.h"
#include "control/joint_controller.h"
#include "tests/support/two_mass_joint.h"

namespace strainwave {
namespace {

// The catalogue's gear csf-17-50 and actuator RHS-17-6006, typed from their pages.
constexpr double kRatio = 50.0;
constexpr double kTorquePerNcm = 0.01 * kRatio;
constexpr double kMotor_kgm2 = 0.089;
constexpr double kPeak_Nm = 34.0;
constexpr double kStall_Nm = 150.0;
constexpr double kTorquePerSpeed_Nms_rad = 19.1;

double damping_Nms_rad(double link_kgm2, double ratio) {
  return 2.0 * ratio * 8100.0 / std::sqrt(8100.0 * (1.0 / kMotor_kgm2 + 1.0 / link_kgm2));
}

TwoMassData joint_at(double temperature_C, double link_kgm2, double damping_ratio, int delay_periods) {
  TwoMassData data;
  data.link_kgm2 = link_kgm2;
  data.slopes_Nm_rad = {8100.0, 11000.0, 13000.0};
  data.corners_Nm = {3.9, 12.0};
  data.damping_Nms_rad = damping_Nms_rad(link_kgm2, damping_ratio);
  const double cold = std::exp(-(temperature_C + 12.803) / 11.28);
  data.static_Nm = kTorquePerNcm * (3.1204 + 6.6525 * cold);
  data.coulomb_Nm = kTorquePerNcm * (1.5204 + 6.6525 * cold);
  data.viscous_Nms_rad =
      kTorquePerNcm * kRatio * 60.0 / (2.0 * std::numbers::pi) * (0.0011702 + 0.01181 * cold);
  data.stribeck_rad_s = 20.0 * 2.0 * std::numbers::pi / 60.0 / kRatio;
  data.stall_Nm = kStall_Nm;
  data.torque_per_speed_Nms_rad = kTorquePerSpeed_Nms_rad;
  data.delay_periods = delay_periods;
  return data;
}

struct Case {
  bool told_of_spring = false;
  int delay_periods = 1;
  double link_kgm2 = 0.0;
  double factor = 0.0;  ///< of the inertia that the joint has, in the table
  double temperature_C = 0.0;
  double target_rad = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << (c.told_of_spring ? "told of a spring" : "by default") << ", link " << c.link_kgm2
             << " kgm2, table for " << c.factor << " times, " << c.temperature_C << " degC, " << c.target_rad
             << " rad, delay " << c.delay_periods;
}

GainTable table_for(double inertia_kgm2) {
  static const GainTable base = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-1.089/c4.json");
  GainTable table = base;
  const double scale = inertia_kgm2 / table.plant.inertia_kgm2;
  table.plant.inertia_kgm2 = inertia_kgm2;
  for (FeedbackGains* gains : {&table.primary, &table.fallback})
    for (int rule = 0; rule < gains->rule_count; ++rule)
      gains->set(rule, scale * gains->gain(rule), gains->lyapunov(rule));
  return table;
}

/// Told what the table says; the delay is told as one period.
JointControllerConfig config_for(const Case& c) {
  JointControllerConfig config;
  config.encoder_resolution_rad = 2.0 * std::numbers::pi / 320000.0;
  config.delay_periods = 1;
  config.torque_limit_Nm = kPeak_Nm;
  config.motor = {kPeak_Nm, kStall_Nm, kTorquePerSpeed_Nms_rad};
  config.motion = {1e3, 1e6, 1e6};  // what the motor can do is the only limit: a plan needs all of the torque
  if (c.told_of_spring) {
    const double link_kgm2 = c.factor * (kMotor_kgm2 + c.link_kgm2) - kMotor_kgm2;
    config.link = {
        kMotor_kgm2, link_kgm2, {8100.0, 3.9, 11000.0, 12.0, 13000.0}, damping_Nms_rad(link_kgm2, 0.03), {}};
  }
  return config;
}

// Chatter is five more reversals of the torque than of the planned acceleration within 50 ms, a swing of 40 Hz and more, and what
// follows on it without a pause of 50 ms.
constexpr int kWindow = 50;
constexpr int kChatter = 5;

/// Periods.
struct Outcome {
  int first_motion = -1;
  int begin = -1;   ///< of the first chatter
  int end = -1;     ///< of the last
  int longest = 0;  ///< of one
  int fallback = -1;
  bool off = false;
};

class ChatterCounter {
 public:
  /// The torque reverses between more than `torque_Nm` on either side.
  explicit ChatterCounter(double torque_Nm) : torque_Nm_(torque_Nm) {}

  void step(int now, double torque_Nm, double planned_rad_s2, Outcome& outcome) {
    if (reversed(planned_rad_s2, 5.0, planned_side_)) planned_.push_back(now);
    if (!reversed(torque_Nm, torque_Nm_, torque_side_)) return;
    if (!turned_.empty() && now - turned_.back() > kWindow) begin_ = -1;
    turned_.push_back(now);
    const auto in_window = [&](const std::vector<int>& times) {
      return times.end() - std::lower_bound(times.begin(), times.end(), now - kWindow);
    };
    if (begin_ < 0 && in_window(turned_) - in_window(planned_) >= kChatter)
      begin_ = *std::lower_bound(turned_.begin(), turned_.end(), now - kWindow);
    if (begin_ < 0) return;
    if (outcome.begin < 0) outcome.begin = begin_;
    outcome.end = now;
    outcome.longest = std::max(outcome.longest, now - begin_);
  }

 private:
  static bool reversed(double value, double threshold, double& side) {
    if (std::abs(value) <= threshold) return false;
    return value * std::exchange(side, value) < 0.0;
  }
  double torque_Nm_;
  double torque_side_ = 0.0;
  double planned_side_ = 0.0;
  std::vector<int> turned_;
  std::vector<int> planned_;
  int begin_ = -1;
};

/// Runs as the daemon would: a joint that is switched off gets no torque.
Outcome run(const Case& c) {
  const TwoMassData data = joint_at(c.temperature_C, c.link_kgm2, 0.01, c.delay_periods);
  TwoMassJoint joint(data);
  JointController controller(config_for(c));
  controller.load(table_for(c.factor * (kMotor_kgm2 + c.link_kgm2)));
  controller.start(joint.reading_rad());
  controller.set_target(c.target_rad);
  // More than the law's own compensation of friction makes, and than the plan of a spring is allowed to be wrong by.
  ChatterCounter counter(2.5 * data.static_Nm + (c.told_of_spring ? 0.2 * kPeak_Nm : 0.0));
  Outcome outcome;
  for (int now = 0; now < 2000; ++now) {
    JointMeasurement measurement;
    measurement.joint_position_rad = joint.reading_rad();
    measurement.temperature_C = c.temperature_C;
    measurement.temperature_valid = true;
    const JointStep step = controller.step(measurement);
    if (step.monitor != MonitorState::kWatching && outcome.fallback < 0) outcome.fallback = now;
    outcome.off = step.monitor == MonitorState::kFaultDue;
    if (outcome.off) break;
    counter.step(now, step.output.torque_Nm, step.reference.acceleration_rad_s2, outcome);
    joint.step(step.output.torque_Nm);
    if (joint.moves() && outcome.first_motion < 0) outcome.first_motion = now;
  }
  return outcome;
}

std::vector<Case> cases(bool told_of_spring, std::initializer_list<double> factors) {
  std::vector<Case> all;
  for (const int delay : {1, 2})
    for (const double link : {0.01, 0.02, 0.06, 0.3})
      for (const double factor : factors)
        for (const double temperature : {-10.0, 20.0, 45.0})
          for (const double target : {0.1, 0.3, 1.0, 3.0})
            all.push_back({told_of_spring, delay, link, factor, temperature, target});
  return all;
}

/// Of many cases; periods.
struct Worst {
  int chattered = 0;
  int off = 0;
  int late = 0;  ///< chatter that begins in the first 100 periods of the motion and has not ended after 500
  int to_fallback = 0;
  int longest = 0;
};

std::ostream& operator<<(std::ostream& out, const Worst& worst) {
  return out << worst.chattered << " chattered, " << worst.off
             << " were switched off; to the fallback at most " << worst.to_fallback << " ms, longest chatter "
             << worst.longest << " ms";
}

Worst worst_of(const std::vector<Case>& all) {
  Worst worst;
  for (const Case& c : all) {
    const Outcome outcome = run(c);
    worst.off += outcome.off ? 1 : 0;
    if (outcome.begin < 0) continue;
    ++worst.chattered;
    EXPECT_GE(outcome.fallback, 0) << c << " chatters for ever";
    const int begin = outcome.begin - outcome.first_motion;
    if (begin <= 100 && outcome.end - outcome.first_motion > 500) ++worst.late;
    worst.to_fallback = std::max(worst.to_fallback, outcome.fallback - outcome.begin);
    worst.longest = std::max(worst.longest, outcome.longest);
  }
  std::cout << all.size() << " cases: " << worst << "\n";
  return worst;
}

// A move that needs all of the torque, on a joint that a table for ten times its inertia makes chatter from the start.
TEST(WrongInertia, EndsWithinHalfASecondOfTheFirstMotionWhereThePlanNeedsAllOfTheTorque) {
  for (const double target_rad : {0.3, 1.0, 3.0}) {
    const Outcome outcome = run({false, 1, 0.02, 10.0, -10.0, target_rad});
    EXPECT_GE(outcome.begin, 0) << "no chatter, and nothing shown";
    EXPECT_LE(outcome.fallback - outcome.begin, 50) << target_rad;
    EXPECT_LE(outcome.end - outcome.first_motion, 500) << target_rad;
  }
}

TEST(WrongInertia, EndsEveryChatterOfTheDefaultInAThirdOfASecond) {
  for (const double factor : {3.0, 6.0, 10.0, 12.0}) {
    const Worst worst = worst_of(cases(false, {factor}));
    EXPECT_GT(worst.chattered, 20) << factor;
    EXPECT_LE(worst.to_fallback, 70) << factor;
    EXPECT_LE(worst.longest, 350) << factor;
    if (factor >= 10.0) {
      EXPECT_EQ(worst.late, 0) << factor;
    }
  }
}

TEST(WrongInertia, EndsEveryChatterOfTheControllerThatIsToldOfASpringInAThirdOfASecond) {
  for (const double factor : {3.0, 6.0, 10.0, 12.0}) {
    const Worst worst = worst_of(cases(true, {factor}));
    EXPECT_GT(worst.chattered, 20) << factor;
    EXPECT_LE(worst.to_fallback, 50) << factor;
    EXPECT_LE(worst.longest, 350) << factor;
    if (factor >= 10.0) {
      EXPECT_EQ(worst.late, 0) << factor;
    }
  }
}

}  // namespace
}  // namespace strainwave
