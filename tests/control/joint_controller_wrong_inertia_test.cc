// The daemon's controller on joints with a spring whose table is for several times the inertia: by default, and told of a spring. What it
// does is no motion any more; that it ends, and how soon, is what is tested. The joint is tests/support/catalogue_joint.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <numbers>
#include <utility>
#include <vector>

#include "control/joint_controller.h"
#include "tests/support/catalogue_joint.h"
#include "tests/support/scaled_table.h"

namespace strainwave {
namespace {

using testing::catalogue_joint;
using testing::damping_Nms_rad;
using testing::kMotor_kgm2;
using testing::kPeak_Nm;
using testing::kStall_Nm;
using testing::kTorquePerSpeed_Nms_rad;

enum class Told : int {
  kNothing = 0,         ///< moves are eased
  kAJerkOfNoLimit = 1,  ///< accelerations step, as they do with a jerk limit that is far too high
  kASpring = 2
};

struct Case {
  Told told = Told::kNothing;
  int delay_periods = 1;
  double link_kgm2 = 0.0;
  double factor = 0.0;  ///< of the inertia that the joint has, in the table
  double temperature_C = 0.0;
  double target_rad = 0.0;
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  constexpr std::array<const char*, 3> kTold = {"by default", "told a jerk of no limit", "told of a spring"};
  return out << kTold.at(static_cast<std::size_t>(c.told)) << ", link " << c.link_kgm2 << " kgm2, table for "
             << c.factor << " times, " << c.temperature_C << " degC, " << c.target_rad << " rad, delay "
             << c.delay_periods;
}

/// Told what the table says; the delay is told as one period.
JointControllerConfig config_for(const Case& c) {
  JointControllerConfig config;
  config.encoder_resolution_rad = 2.0 * std::numbers::pi / 320000.0;
  config.delay_periods = 1;
  config.torque_limit_Nm = kPeak_Nm;
  config.motor = {kPeak_Nm, kStall_Nm, kTorquePerSpeed_Nms_rad};
  config.motion = {1e3, 1e6, 1e6};  // what the motor can do is the only limit: a plan needs all of the torque
  if (c.told == Told::kAJerkOfNoLimit) config.jerk_limit_rad_s3 = 1e12;
  if (c.told == Told::kASpring) {
    const double link_kgm2 = c.factor * (kMotor_kgm2 + c.link_kgm2) - kMotor_kgm2;
    config.link = {
        kMotor_kgm2, link_kgm2, {8100.0, 3.9, 11000.0, 12.0, 13000.0}, damping_Nms_rad(link_kgm2, 0.03), {}};
  }
  return config;
}

// Chatter is five reversals of the torque that no plan orders within 50 ms, a swing of 40 Hz and more, and what follows on it without a
// pause of 50 ms. One to the side to which the planned acceleration turns at that time is the plan's own.
constexpr int kWindow = 50;
constexpr std::size_t kChatter = 5;
constexpr int kOrdered = 3;

/// Periods.
struct Outcome {
  int first_motion = -1;
  int brakes = -1;     ///< the plan, for the first time
  int begin = -1;      ///< of the first chatter
  int first_end = -1;  ///< of the same
  int end = -1;        ///< of the last
  int longest = 0;     ///< of one
  int fallback = -1;
  bool off = false;
};

class ChatterCounter {
 public:
  /// The torque reverses between more than `torque_Nm` on either side.
  explicit ChatterCounter(double torque_Nm) : torque_{torque_Nm, 0.0, {}} {}

  void step(int now, double torque_Nm, double planned_rad_s2) {
    torque_.step(now, torque_Nm);
    plan_.step(now, planned_rad_s2);
  }
  void judge(Outcome& outcome) const {
    if (!plan_.turns.empty()) outcome.brakes = plan_.turns.front().at;
    std::vector<int> turned;
    for (const Turn& turn : torque_.turns)
      if (!ordered(turn)) turned.push_back(turn.at);
    int begin = -1;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      if (i > 0 && turned[i] - turned[i - 1] > kWindow) begin = -1;
      if (begin < 0 && i + 1 >= kChatter && turned[i] - turned[i + 1 - kChatter] <= kWindow)
        begin = turned[i + 1 - kChatter];
      if (begin < 0) continue;
      if (outcome.begin < 0) outcome.begin = begin;
      if (outcome.begin == begin) outcome.first_end = turned[i];
      outcome.end = turned[i];
      outcome.longest = std::max(outcome.longest, turned[i] - begin);
    }
  }

 private:
  struct Turn {
    int at = 0;
    bool up = false;
  };
  struct Side {
    void step(int now, double value) {
      if (std::abs(value) <= threshold) return;
      if (value * std::exchange(last, value) < 0.0) turns.push_back({now, value > 0.0});
    }
    double threshold = 0.0;
    double last = 0.0;
    std::vector<Turn> turns;
  };
  bool ordered(const Turn& turn) const {
    return std::any_of(plan_.turns.begin(), plan_.turns.end(), [&](const Turn& plan) {
      return plan.up == turn.up && std::abs(plan.at - turn.at) <= kOrdered;
    });
  }
  Side torque_;
  Side plan_{5.0, 0.0, {}};
};

/// Runs as the daemon would: a joint that is switched off gets no torque.
Outcome run(const Case& c) {
  const TwoMassData data = catalogue_joint(c.temperature_C, c.link_kgm2, 0.01, c.delay_periods);
  TwoMassJoint joint(data);
  JointController controller(config_for(c));
  controller.load(testing::scaled_table("total-1.089/c4.json", c.factor * (kMotor_kgm2 + c.link_kgm2)));
  controller.start(joint.reading_rad());
  controller.set_target(c.target_rad);
  // More than the law's own compensation of friction makes, and than the plan of a spring is allowed to be wrong by.
  ChatterCounter counter(2.5 * data.static_Nm + (c.told == Told::kASpring ? 0.2 * kPeak_Nm : 0.0));
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
    counter.step(now, step.output.torque_Nm, step.reference.acceleration_rad_s2);
    joint.step(step.output.torque_Nm);
    if (joint.moves() && outcome.first_motion < 0) outcome.first_motion = now;
  }
  counter.judge(outcome);
  return outcome;
}

std::vector<Case> cases(Told told, std::initializer_list<double> factors) {
  std::vector<Case> all;
  for (const int delay : {1, 2})
    for (const double link : {0.01, 0.02, 0.06, 0.3})
      for (const double factor : factors)
        for (const double temperature : {-10.0, 20.0, 45.0})
          for (const double target : {0.1, 0.3, 1.0, 3.0})
            all.push_back({told, delay, link, factor, temperature, target});
  return all;
}

/// Of many cases; periods.
struct Worst {
  int chattered = 0;
  int off = 0;
  int late = 0;  ///< chatter that begins in the first 100 periods of the motion and has not ended after 500
  int at_braking = 0;    ///< chatter that begins in the first 100 periods of braking, and not before
  int late_braking = 0;  ///< of that, what has not ended 500 periods after braking began
  int to_fallback = 0;   ///< since chatter began, unless it has ended by itself
  int longest = 0;
};

std::ostream& operator<<(std::ostream& out, const Worst& worst) {
  return out << worst.chattered << " chattered, " << worst.at_braking << " from braking on, " << worst.off
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
    if (begin <= 100 && outcome.first_end - outcome.first_motion > 500) ++worst.late;
    const int braking = outcome.brakes < 0 ? -1 : outcome.begin - outcome.brakes;
    if (braking >= 0 && braking <= 100) {
      ++worst.at_braking;
      if (outcome.first_end - outcome.brakes > 500) ++worst.late_braking;
    }
    worst.to_fallback =
        std::max(worst.to_fallback, std::min(outcome.fallback, outcome.first_end) - outcome.begin);
    worst.longest = std::max(worst.longest, outcome.longest);
  }
  std::cout << all.size() << " cases: " << worst << "\n";
  return worst;
}

// A move that needs all of the torque from its first period on, on a joint that a table for ten times its inertia makes chatter from
// the start.
TEST(WrongInertia, EndsWithinHalfASecondOfTheFirstMotionWhereThePlanNeedsAllOfTheTorque) {
  for (const double target_rad : {0.3, 1.0, 3.0}) {
    const Outcome outcome = run({Told::kAJerkOfNoLimit, 1, 0.02, 10.0, -10.0, target_rad});
    EXPECT_GE(outcome.begin, 0) << "no chatter, and nothing shown";
    EXPECT_LE(outcome.fallback - outcome.begin, 50) << target_rad;
    EXPECT_LE(outcome.end - outcome.first_motion, 500) << target_rad;
  }
}

TEST(WrongInertia, EndsEveryChatterOfTheDefaultInAThirdOfASecond) {
  for (const double factor : {3.0, 6.0, 10.0, 12.0}) {
    const Worst worst = worst_of(cases(Told::kNothing, {factor}));
    EXPECT_GT(worst.chattered, 10) << factor;
    EXPECT_LE(worst.to_fallback, 60) << factor;
    EXPECT_EQ(worst.late_braking, 0) << factor;
    EXPECT_LE(worst.longest, 350) << factor;
    if (factor >= 6.0) {
      EXPECT_GT(worst.at_braking, 0) << factor;
    }
    if (factor >= 10.0) {
      EXPECT_EQ(worst.late, 0) << factor;
    }
  }
}

TEST(WrongInertia, EndsEveryChatterInAThirdOfASecondWhereAccelerationsStep) {
  for (const double factor : {3.0, 6.0, 10.0, 12.0}) {
    const Worst worst = worst_of(cases(Told::kAJerkOfNoLimit, {factor}));
    EXPECT_GT(worst.chattered, 20) << factor;
    EXPECT_LE(worst.to_fallback, 50) << factor;
    EXPECT_EQ(worst.late_braking, 0) << factor;
    EXPECT_GT(worst.at_braking, 0) << factor;
    EXPECT_LE(worst.longest, 350) << factor;
    if (factor >= 10.0) {
      EXPECT_EQ(worst.late, 0) << factor;
    }
  }
}

TEST(WrongInertia, EndsEveryChatterOfTheControllerThatIsToldOfASpringInAThirdOfASecond) {
  for (const double factor : {3.0, 6.0, 10.0, 12.0}) {
    const Worst worst = worst_of(cases(Told::kASpring, {factor}));
    EXPECT_GT(worst.chattered, 10) << factor;
    EXPECT_LE(worst.to_fallback, 40) << factor;
    EXPECT_EQ(worst.late_braking, 0) << factor;
    EXPECT_LE(worst.longest, 350) << factor;
    if (factor >= 10.0) {
      EXPECT_EQ(worst.late, 0) << factor;
    }
  }
}

}  // namespace
}  // namespace strainwave
