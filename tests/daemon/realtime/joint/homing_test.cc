// SPDX-License-Identifier: BSD-3-Clause
// The state machine of homing, on an ideal joint without control law and friction, which goes exactly where it is ordered.
#include "daemon/realtime/joint/homing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "drivers/simulated_inputs.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kSpeed_rad_s = 0.05;
constexpr double kDeceleration_rad_s2 = 5.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Moves at the ordered speed, and stops with a deceleration.
class Walker {
 public:
  Walker(double position_rad, const SimulatedInputsConfig& inputs)
      : position_rad_(position_rad), inputs_(inputs) {
    (void)inputs_.at(position_rad, position_rad);
  }

  Homing::Observation observe() {
    return {position_rad_, falsify(inputs_.at(position_rad_, position_rad_)), now_ns_, torque_Nm_};
  }
  void obey(const Homing::Order& order, double speed_rad_s) {
    if (order.kind == Homing::Order::Kind::kMove) {
      target_rad_ = order.target_rad;
      wanted_rad_s_ = std::copysign(speed_rad_s, target_rad_ - position_rad_);
    } else if (order.kind == Homing::Order::Kind::kStop) {
      wanted_rad_s_ = 0.0;
    }
    if (std::abs(target_rad_ - position_rad_) <= std::abs(wanted_rad_s_) * kPeriod_s)
      wanted_rad_s_ = velocity_rad_s_ = 0.0;
    const double step = kDeceleration_rad_s2 * kPeriod_s;
    velocity_rad_s_ += std::clamp(wanted_rad_s_ - velocity_rad_s_, -step, step);
    position_rad_ += velocity_rad_s_ * kPeriod_s;
    // At its mechanical stop the joint stands, and the control law pushes ever harder. Elsewhere there is friction.
    const bool pushes = position_rad_ <= stop_rad && wanted_rad_s_ < 0.0;
    if (pushes) position_rad_ = stop_rad;
    torque_Nm_ = pushes ? torque_Nm_ - kPush_Nm_s * kPeriod_s : std::copysign(friction_Nm, velocity_rad_s_);
    hardest_Nm = std::max(hardest_Nm, std::abs(torque_Nm_));
    lowest_rad_ = std::min(lowest_rad_, position_rad_);
    highest_rad_ = std::max(highest_rad_, position_rad_);
    now_ns_ += 1'000'000;
  }
  /// Runs until `homing` has ended, or for `limit_s`.
  void run(Homing& homing, double speed_rad_s = kSpeed_rad_s, double limit_s = 100.0) {
    obey(homing.begin(observe()), speed_rad_s);
    for (int i = 0; i < limit_s / kPeriod_s; ++i) {
      const Homing::Phase phase = homing.phase();
      if (phase == Homing::Phase::kFound || phase == Homing::Phase::kFailed) return;
      obey(homing.step(observe()), speed_rad_s);
    }
  }

  double position_rad_;
  double lowest_rad_ = kInfinity;
  double highest_rad_ = -kInfinity;
  double stop_rad = -kInfinity;
  double friction_Nm = 4.0;
  double hardest_Nm = 0.0;
  std::int64_t now_ns_ = 0;
  std::function<JointInputs(JointInputs)> falsify = [](JointInputs inputs) { return inputs; };

 private:
  SimulatedInputs inputs_;
  double velocity_rad_s_ = 0.0;
  double wanted_rad_s_ = 0.0;
  double target_rad_ = 0.0;
  double torque_Nm_ = 0.0;
  static constexpr double kPush_Nm_s = 50.0;
};

HomingConfig against_a_stop() {
  HomingConfig config;
  config.target = HomingTarget::kStop;
  config.speed_rad_s = kSpeed_rad_s;
  config.stop_torque_Nm = 10.0;
  config.travel_rad = 2.0;
  return config;
}

TEST(Homing, FindsItsMechanicalStopAndPushesNoHarderThanItMust) {
  Walker walker(0.5, {});
  walker.stop_rad = -0.3;
  Homing homing(against_a_stop());
  walker.run(homing);
  ASSERT_EQ(homing.phase(), Homing::Phase::kFound);
  EXPECT_NEAR(homing.found_rad(), -0.3, 1e-6);
  EXPECT_LT(walker.hardest_Nm, 10.0 + 50.0 * 0.12) << "a tenth of a second longer than the stop torque";
}

TEST(Homing, TakesFrictionForNoStopAndFailsWhereThereIsNone) {
  Walker walker(0.5, {});
  walker.friction_Nm = 12.0;  // more than the stop torque, but the joint moves
  Homing homing(against_a_stop());
  walker.run(homing);
  EXPECT_EQ(homing.phase(), Homing::Phase::kFailed);
  EXPECT_LE(walker.position_rad_, 0.5 - 1.9) << "after the whole travel";
}

HomingConfig config_to(HomingTarget target) {
  HomingConfig config;
  config.target = target;
  config.speed_rad_s = kSpeed_rad_s;
  config.travel_rad = 2.5;
  config.timeout_s = 100.0;
  return config;
}

/// Limits at -1 and 1, a home switch from 0.30 to 0.35, index pulses every 0.125 from 0.01.
SimulatedInputsConfig inputs() {
  return {-1.0, 1.0, 0.30, 0.35, 0.01, 0.125};
}

constexpr double kPerPeriod_rad = kSpeed_rad_s * kPeriod_s;

TEST(Homing, FindsTheSamePlaceFromAnywhere) {
  HomingConfig upwards = config_to(HomingTarget::kHomeSwitch);
  upwards.direction = 1.0;
  HomingConfig then_index = config_to(HomingTarget::kHomeSwitch);
  then_index.then_index = true;
  SimulatedInputsConfig narrow = inputs();
  narrow.home_to_rad = narrow.home_from_rad + 1e-4;  // the joint needs 2.5e-4 to reverse
  HomingConfig positive_limit = config_to(HomingTarget::kLimitSwitch);
  positive_limit.direction = 1.0;
  constexpr double kEdge_rad = 2.0 * kPerPeriod_rad;
  constexpr double kPulse_rad = 1e-12;  // the pulse's position, not the joint's next reading
  const struct {
    const char* what;
    HomingConfig config;
    SimulatedInputsConfig inputs;
    std::vector<double> begins_rad;
    double found_rad;
    double within_rad;
  } cases[] = {
      {"negative limit",
       config_to(HomingTarget::kLimitSwitch),
       inputs(),
       {-1.01, -0.99, -0.5, 0.3, 0.99},
       -1.0,
       kEdge_rad},
      {"positive limit", positive_limit, inputs(), {0.2, -1.01}, 1.0, kEdge_rad},
      {"upper edge, also from below, by way of the limit switch and past the switch",
       config_to(HomingTarget::kHomeSwitch),
       inputs(),
       {0.9, 0.36, 0.349, 0.31, 0.29, -0.5, -0.999, -1.2},
       0.35,
       kEdge_rad},
      {"lower edge", upwards, inputs(), {-0.5, 0.32, 0.6}, 0.30, kEdge_rad},
      {"narrow switch",
       config_to(HomingTarget::kHomeSwitch),
       narrow,
       {0.8, -0.2},
       narrow.home_to_rad,
       kEdge_rad},
      {"index alone", config_to(HomingTarget::kIndex), inputs(), {0.2}, 0.135, kPulse_rad},
      {"index alone, from a limit switch",
       config_to(HomingTarget::kIndex),
       inputs(),
       {-1.01},
       -0.99,
       kPulse_rad},
      {"first index above the switch", then_index, inputs(), {0.9, -0.5}, 0.385, kPulse_rad},
  };
  for (const auto& one : cases)
    for (const double begin_rad : one.begins_rad) {
      Homing homing(one.config);
      Walker joint(begin_rad, one.inputs);
      joint.run(homing);
      ASSERT_EQ(homing.phase(), Homing::Phase::kFound) << one.what << ", " << begin_rad;
      EXPECT_NEAR(homing.found_rad(), one.found_rad, one.within_rad) << one.what << ", " << begin_rad;
    }
}

TEST(Homing, GivesUpAfterItsTime) {
  HomingConfig config = config_to(HomingTarget::kHomeSwitch);
  config.timeout_s = 0.5;
  Homing homing(config);
  Walker joint(0.9, inputs());
  joint.run(homing);
  EXPECT_EQ(homing.phase(), Homing::Phase::kFailed);
  EXPECT_NEAR(static_cast<double>(joint.now_ns_) * 1e-9, 0.5, 0.005);
}

TEST(Homing, TurnsAtALimitSwitchOnceAndNotTwice) {
  SimulatedInputsConfig without_home = inputs();
  without_home.home_to_rad = -1.0;
  Homing homing(config_to(HomingTarget::kHomeSwitch));
  Walker joint(-0.6, without_home);
  joint.run(homing);
  EXPECT_EQ(homing.phase(), Homing::Phase::kFailed);
  EXPECT_LT(joint.lowest_rad_, -0.99);
  EXPECT_GT(joint.highest_rad_, 0.99);
}

TEST(Homing, RefusesBothLimitsAtOnceWhichIsABrokenWire) {
  Homing homing(config_to(HomingTarget::kLimitSwitch));
  Walker joint(0.0, inputs());
  joint.falsify = [](JointInputs input) {
    input.negative_limit = input.positive_limit = true;
    return input;
  };
  const double begin_rad = joint.position_rad_;
  joint.run(homing);
  EXPECT_EQ(homing.phase(), Homing::Phase::kFailed);
  EXPECT_EQ(joint.position_rad_, begin_rad) << "before anything moves";
}

TEST(Homing, TakesNoDisturbanceOfOnePeriodForItsSwitch) {
  Homing homing(config_to(HomingTarget::kHomeSwitch));
  Walker joint(0.9, inputs());
  bool disturbed = false;
  joint.falsify = [&](JointInputs input) {
    if (joint.position_rad_ < 0.7 && !disturbed) input.home = disturbed = true;
    return input;
  };
  joint.run(homing);
  ASSERT_EQ(homing.phase(), Homing::Phase::kFound);
  EXPECT_TRUE(disturbed);
  EXPECT_NEAR(homing.found_rad(), 0.35, 2.0 * kPerPeriod_rad);
}

TEST(Homing, EndsAtTheTravelWhenASwitchNeverOpensOrNeverCloses) {
  for (const bool stuck : {true, false}) {
    HomingConfig config = config_to(HomingTarget::kHomeSwitch);
    config.travel_rad = 0.1;
    Homing homing(config);
    Walker joint(0.0, inputs());
    joint.falsify = [stuck](JointInputs input) {
      input.home = stuck;
      return input;
    };
    joint.run(homing);
    EXPECT_EQ(homing.phase(), Homing::Phase::kFailed) << stuck;
    EXPECT_LE(std::max(joint.highest_rad_, -joint.lowest_rad_), 0.1 + kPerPeriod_rad) << stuck;
  }
}

}  // namespace
}  // namespace strainwave
