#include "control/state_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace strainwave {
namespace {

constexpr double kCount_rad = 2e-5;
constexpr double kPeriod_s = 0.001;
constexpr double kFriction_Nm = 3.0;
constexpr double kInertia_kgm2 = 0.089;

// Coulomb friction alone, so that a sliding joint's path is a parabola that this test writes down itself.
JointModel model() {
  return {kInertia_kgm2, {kFriction_Nm, kFriction_Nm, 0.0}, {0.042, 2.0}, 1.6};
}

StateEstimator estimator(int delay_periods, double encoder_resolution_rad = kCount_rad) {
  StateEstimator result({{kPeriod_s, encoder_resolution_rad, 0.02}, delay_periods});
  result.reset(0.0, 0.0, 0.0, model().friction_scale_Nm);
  return result;
}

double read(double position_rad) {
  return std::nearbyint(position_rad / kCount_rad) * kCount_rad;
}

JointMeasurement at(double position_rad, int elapsed_periods = 1, int late_periods = 0) {
  JointMeasurement measurement;
  measurement.joint_position_rad = position_rad;
  measurement.elapsed_periods = elapsed_periods;
  measurement.late_periods = late_periods;
  return measurement;
}

// Positions at each sample of a joint from rest that feels `torques_Nm`, each over one period, always sliding forwards.
std::vector<double> path(const std::vector<double>& torques_Nm) {
  std::vector<double> positions_rad{0.0};
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  for (const double torque_Nm : torques_Nm) {
    const double acceleration =
        torque_Nm > kFriction_Nm || velocity_rad_s > 0.0 ? (torque_Nm - kFriction_Nm) / kInertia_kgm2 : 0.0;
    position_rad += kPeriod_s * velocity_rad_s + 0.5 * kPeriod_s * kPeriod_s * acceleration;
    velocity_rad_s += kPeriod_s * acceleration;
    positions_rad.push_back(position_rad);
  }
  return positions_rad;
}

TEST(StateEstimator, ByReadingsAloneTheVelocityIsTheDifferenceOverThePeriodsThatHavePassed) {
  StateEstimator state = estimator(2);
  state.step(at(0.0), model(), EstimateSource::kReadings);
  state.step(at(0.003), model(), EstimateSource::kReadings);
  EXPECT_DOUBLE_EQ(state.now().velocity_rad_s, 3.0);
  state.step(at(0.015, 4), model(), EstimateSource::kReadings);
  EXPECT_NEAR(state.now().velocity_rad_s, 3.0, 1e-12);
  EXPECT_EQ(state.then().position_rad, 0.015);
  EXPECT_EQ(state.model().inertia_kgm2, kInertia_kgm2);
}

TEST(StateEstimator, AtRestACountToEitherSideIsNoVelocityAndWhatGoesFartherIs) {
  StateEstimator state = estimator(0);
  const auto velocity_at = [&](int count, EstimateSource source = EstimateSource::kReadingsAtRest) {
    state.step(at(count * kCount_rad), model(), source);
    return state.now().velocity_rad_s * kPeriod_s / kCount_rad;
  };
  velocity_at(0);
  for (const int count : {1, -1, 0}) velocity_at(count);
  for (const int count : {1, 0, -1, 1, 1, -1, 1}) EXPECT_EQ(velocity_at(count), 0.0) << count;
  EXPECT_EQ(state.now().position_rad, kCount_rad) << "the position is the reading";
  // On it goes with all of it, back with all but the play.
  EXPECT_NEAR(velocity_at(3), 2.0, 0.03);
  EXPECT_NEAR(velocity_at(4), 1.0, 1e-9);
  EXPECT_NEAR(velocity_at(2), 0.0, 1e-9);
  EXPECT_NEAR(velocity_at(1), -1.0, 0.03);
  EXPECT_NEAR(velocity_at(0), -1.0, 1e-9);
  // What moves is not at rest: the plain difference, and the play goes along.
  EXPECT_NEAR(velocity_at(2, EstimateSource::kReadings), 2.0, 1e-9);
  EXPECT_NEAR(velocity_at(12, EstimateSource::kReadings), 10.0, 1e-9);
  EXPECT_NEAR(velocity_at(12), 0.0, 1e-9);
}

TEST(StateEstimator, AMeasuredVelocityIsPreferredToTheDifferenceOfTwoReadings) {
  StateEstimator state = estimator(0);
  JointMeasurement measurement = at(0.003);
  measurement.has_velocity = true;
  measurement.joint_velocity_rad_s = 0.25;
  state.step(measurement, model(), EstimateSource::kReadings);
  EXPECT_EQ(state.now().velocity_rad_s, 0.25);
}

TEST(StateEstimator, ByReadingsAloneTheLoadIsTheOneThatWasHeldAtTheStart) {
  StateEstimator state = estimator(0);
  state.reset(0.5, 0.0, 7.5, model().friction_scale_Nm);
  state.step(at(0.5), model(), EstimateSource::kReadings);
  EXPECT_EQ(state.now().disturbance.load_Nm, 7.5);
}

// The joint of the next three: 12 N.m for 100 periods.
constexpr double kTorque_Nm = 12.0;
constexpr std::size_t kPeriods = 100;

TEST(StateEstimator, ForeseesWhereTheJointIsWhenThisPeriodsTorqueBeginsToAct) {
  for (const int delay_periods : {0, 1, 2, 5}) {
    StateEstimator state = estimator(delay_periods);
    std::vector<double> torques_Nm(static_cast<std::size_t>(delay_periods), 0.0);
    torques_Nm.resize(kPeriods + static_cast<std::size_t>(delay_periods) + 1, kTorque_Nm);
    const std::vector<double> true_rad = path(torques_Nm);
    for (std::size_t k = 0; k < kPeriods; ++k) {
      state.step(at(read(true_rad[k])), model(), EstimateSource::kObserver);
      state.remember(kTorque_Nm);
    }
    const std::size_t then = kPeriods - 1 + static_cast<std::size_t>(delay_periods);
    EXPECT_NEAR(state.now().position_rad, true_rad[kPeriods - 1], kCount_rad) << delay_periods;
    EXPECT_NEAR(state.then().position_rad, true_rad[then], 2.0 * kCount_rad) << delay_periods;
  }
}

TEST(StateEstimator, OverPeriodsThatWereLeftOutTheLastTorqueWentOn) {
  StateEstimator state = estimator(1);
  std::vector<double> torques_Nm(1, 0.0);
  torques_Nm.resize(kPeriods + 2, kTorque_Nm);
  const std::vector<double> true_rad = path(torques_Nm);
  bool surprised = false;
  for (std::size_t k = 0; k < kPeriods;) {
    const int elapsed_periods = k == 50 ? 5 : 1;
    state.step(at(read(true_rad[k]), elapsed_periods), model(), EstimateSource::kObserver);
    surprised = surprised || state.now().surprised;
    state.remember(kTorque_Nm);
    k += k == 45 ? 5 : 1;
  }
  EXPECT_FALSE(surprised);
  EXPECT_NEAR(state.now().position_rad, true_rad[kPeriods - 1], kCount_rad);
}

// Order k acts from the sample k + kDelay on. The drive is not asked for a sample over the stall, and takes no torque.
TEST(StateEstimator, OverAStallInWhichTheDriveWaitsTheTorquesUnderWayWaitToo) {
  constexpr std::size_t kDelay = 3;
  constexpr std::size_t kStall = 4;
  constexpr std::size_t kAfter = 51;  // the first period after it
  const auto order_Nm = [](std::size_t k) { return k % 2 == 0 ? 4.0 : 10.0; };
  std::vector<double> torques_Nm(kDelay, 0.0);
  for (std::size_t k = 0; k < kPeriods; ++k)
    torques_Nm.insert(torques_Nm.end(), k + kDelay == kAfter ? 1 + kStall : 1, order_Nm(k));
  const std::vector<double> true_rad = path(torques_Nm);
  StateEstimator state = estimator(kDelay);
  bool surprised = false;
  for (std::size_t k = 0; k < kPeriods; ++k) {
    const bool after = k == kAfter;
    state.step(at(read(true_rad[k > kAfter ? k + kStall : k]), after ? 1 + kStall : 1, after ? kStall : 0),
               model(), EstimateSource::kObserver);
    surprised = surprised || state.now().surprised;
    if (after) {
      EXPECT_NEAR(state.then().position_rad, true_rad[k + kStall + kDelay], 3.0 * kCount_rad);
    }
    state.remember(order_Nm(k));
  }
  EXPECT_FALSE(surprised);
  EXPECT_NEAR(state.now().position_rad, true_rad[kPeriods - 1 + kStall], kCount_rad);
}

TEST(StateEstimator, ALatePositionIsTakenForOneOfThePast) {
  StateEstimator state = estimator(1);
  std::vector<double> torques_Nm(1, 0.0);
  torques_Nm.resize(kPeriods + 2, kTorque_Nm);
  const std::vector<double> true_rad = path(torques_Nm);
  for (std::size_t k = 0; k < kPeriods; ++k) {
    const std::size_t late = k < 60 ? 0 : 2;
    state.step(at(read(true_rad[k - late]), 1, static_cast<int>(late)), model(), EstimateSource::kObserver);
    state.remember(kTorque_Nm);
  }
  EXPECT_EQ(state.late_periods(), 2);
  EXPECT_NEAR(state.now().position_rad, true_rad[kPeriods - 3], kCount_rad);
  EXPECT_NEAR(state.then().position_rad, true_rad[kPeriods], 3.0 * kCount_rad);
}

TEST(StateEstimator, APositionIsNoLaterThanTheTorquesThatAreRemembered) {
  StateEstimator state = estimator(kMaxControlDelay - 1);
  state.step(at(0.0, 1, 1000), model(), EstimateSource::kObserver);
  EXPECT_EQ(state.late_periods(), 1);
}

TEST(StateEstimator, CountsHowLongTheReadingStands) {
  StateEstimator state = estimator(0);
  state.step(at(0.0), model(), EstimateSource::kReadings);
  state.step(at(0.0, 3), model(), EstimateSource::kReadings);
  EXPECT_EQ(state.still_periods(), 4);
  state.step(at(kCount_rad), model(), EstimateSource::kReadings);
  EXPECT_EQ(state.still_periods(), 0);
  for (int k = 0; k < 3 * kMaxElapsedPeriods; ++k)
    state.step(at(kCount_rad), model(), EstimateSource::kReadings);
  EXPECT_EQ(state.still_periods(), kMaxElapsedPeriods);
}

TEST(StateEstimator, LearnsNothingFromAPositionThatIsNoReading) {
  StateEstimator told = estimator(0);
  StateEstimator untold = estimator(0);
  JointMeasurement guessed = at(0.001);
  for (StateEstimator* state : {&told, &untold}) state->step(at(0.0), model(), EstimateSource::kObserver);
  untold.step(guessed, model(), EstimateSource::kObserver);
  EXPECT_TRUE(untold.now().surprised);
  EXPECT_NE(untold.now().position_rad, 0.0);
  guessed.has_position = false;
  told.step(guessed, model(), EstimateSource::kObserver);
  EXPECT_FALSE(told.now().surprised);
  EXPECT_EQ(told.now().position_rad, 0.0);
}

// A mean fades and never ends by itself: what rests must be seen to rest.
TEST(StateEstimator, ASmoothedVelocityOfAReadingThatStandsIsSoonExactlyZero) {
  for (const double resolution_rad : {0.0, 2e-5}) {
    StateEstimatorConfig config;
    config.observer.period_s = 1e-3;
    config.observer.encoder_resolution_rad = resolution_rad;
    config.velocity_share = 0.125;
    StateEstimator estimator(config);
    estimator.reset(0.0, 0.0, 0.0, 1.0);
    estimator.step({.joint_position_rad = 4e-5}, {}, EstimateSource::kReadings);
    EXPECT_GT(estimator.now().velocity_rad_s, 0.0);
    for (int k = 0; k < 150; ++k) estimator.step({.joint_position_rad = 4e-5}, {}, EstimateSource::kReadings);
    EXPECT_EQ(estimator.now().velocity_rad_s, 0.0) << resolution_rad;
  }
}

}  // namespace
}  // namespace strainwave
