// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/state_record.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

class StateRecordTest : public ::testing::Test {
 protected:
  StateRecordTest() {
    reading_.joint_position_rad = 0.5;
    reading_.torque_applied_Nm = 3.0;
    motion_.ordered_reference = {0.6, 0.2, 0.0};
    motion_.output.torque_Nm = 4.0;
    zero_.set(0.0, 1.0);
    rules_.rule_count = 2;
    rules_.rules[1].center_C = 40.0;
    weights_.weight[0] = 0.25;
    weights_.weight[1] = 0.75;
  }
  void enable() {
    (void)mode_.apply(ModeEvent::kEnableOrdered, 1);
    (void)mode_.apply(ModeEvent::kDriveReady, 2);
  }
  const state_v1& filled() {
    JointCycle cycle{time_, mode_, reading_, motion_, zero_, ordered_, temperature_, weights_};
    cycle.target_rad = 0.75;
    cycle.joint_velocity_rad_s = 0.15;
    cycle.table_id = 77;
    cycle.friction_rules_id = 78;
    cycle.friction_rules = &rules_;
    cycle.learned = learned_;
    cycle.friction_factor = 1.25;
    cycle.friction = friction_;
    cycle.notices = 5;
    cycle.inertia_kgm2 = inertia_kgm2_;
    cycle.yield = yield_;
    fill_record(cycle, record_);
    return record_.state;
  }
  CycleTime time_{3'000'000'000, 42};
  JointMode mode_;
  ActuatorReading reading_;
  JointStep motion_;
  JointZero zero_{false};
  OrderedTarget ordered_;
  TemperatureCheck temperature_{TemperatureCheckConfig{}};
  TemperatureWeights weights_;
  FuzzyFriction rules_;
  LearnedFriction learned_;
  FrictionHistory friction_;
  std::optional<double> inertia_kgm2_;
  std::optional<Yield> yield_;
  StateRecord record_;
};

TEST_F(StateRecordTest, ShowsTheMeasuredPlaceAsSetpointAndTargetWhileNothingIsControlled) {
  const state_v1& state = filled();
  EXPECT_EQ(state.joint_position_rad, 1.5);
  EXPECT_EQ(state.setpoint_position_rad, 1.5);
  EXPECT_EQ(state.target_position_rad, 1.5);
  EXPECT_EQ(state.setpoint_velocity_rad_s, 0.0);
  EXPECT_EQ(state.joint_velocity_rad_s, 0.15) << "a joint may coast";
  EXPECT_EQ(state.torque_commanded_Nm, 0.0) << "whatever the last motion was";
  EXPECT_EQ(state.torque_applied_Nm, 3.0);
}

TEST_F(StateRecordTest, ShowsReferenceTargetAndEstimateUnderControlAllFromOneZero) {
  enable();
  const state_v1& state = filled();
  EXPECT_DOUBLE_EQ(state.setpoint_position_rad, 1.6);
  EXPECT_DOUBLE_EQ(state.target_position_rad, 1.75);
  EXPECT_EQ(state.joint_position_rad, 1.5);
  EXPECT_EQ(state.setpoint_velocity_rad_s, 0.2);
  EXPECT_EQ(state.joint_velocity_rad_s, 0.15);
  EXPECT_EQ(state.torque_commanded_Nm, 4.0);
}

TEST_F(StateRecordTest, ShowsTheLinkFromTheSameZeroAndNoNumberWhereNothingMeasuresIt) {
  reading_.link_position_rad = 0.25;
  EXPECT_TRUE(std::isnan(filled().link_position_rad));
  reading_.has_link_position = true;
  EXPECT_EQ(filled().link_position_rad, 1.25);
}

TEST_F(StateRecordTest, ShowsNoInertiaBeforeMotionsHaveShownOne) {
  EXPECT_TRUE(std::isnan(filled().inertia_estimated_kgm2));
  inertia_kgm2_ = 0.18;
  EXPECT_EQ(filled().inertia_estimated_kgm2, 0.18);
}

TEST_F(StateRecordTest, ShowsHowFarThePathHasGotWhileThereIsOne) {
  EXPECT_TRUE(std::isnan(filled().path_time_s));
  ordered_.begin_path(1.75, 0.75);
  ordered_.note({3.25, true});
  EXPECT_EQ(filled().path_time_s, 3.25);
  ordered_.end();
  EXPECT_TRUE(std::isnan(filled().path_time_s));
}

TEST_F(StateRecordTest, ShowsAYieldAsLongAsTheJointIsToTellOfIt) {
  EXPECT_TRUE(std::isnan(filled().yield_load_Nm));
  EXPECT_TRUE(std::isnan(filled().yield_limit_Nm));
  EXPECT_TRUE(std::isnan(filled().yield_position_rad));
  yield_ = Yield{13.1, 12.0, 0.301};
  EXPECT_EQ(filled().yield_load_Nm, 13.1);
  EXPECT_EQ(filled().yield_limit_Nm, 12.0);
  EXPECT_EQ(filled().yield_position_rad, 0.301);
}

TEST_F(StateRecordTest, ShowsWhatWasLearnedOfFrictionWhenAndWithWhichRules) {
  EXPECT_EQ(filled().friction_age_s, -1.0);
  EXPECT_TRUE(std::isnan(filled().friction_learned_C));
  learned_.scale[1] = 0.5;
  learned_.load_Nm = -2.0;
  friction_ = {.frozen = true, .learned_C = 18.0, .learned_ns = 1'000'000'000};
  const state_v1& state = filled();
  EXPECT_EQ(state.friction_factor, 1.25);
  EXPECT_EQ(state.friction_learned_C, 18.0);
  EXPECT_DOUBLE_EQ(state.friction_age_s, 2.0);
  EXPECT_EQ(state.friction_frozen, 1);
  EXPECT_EQ(state.friction_rule_C[1], 40.0);
  EXPECT_EQ(state.friction_scales[1], 0.5);
  EXPECT_EQ(state.learned_load_Nm, -2.0);
  EXPECT_EQ(record_.friction_rules_id, 78);
}

TEST_F(StateRecordTest, TellsTheFlightRecorderOfEveryNotice) {
  for (std::uint32_t notice = 1; notice <= static_cast<std::uint32_t>(Notice::kFrictionDiffers);
       notice <<= 1U) {
    record_.state.notices = static_cast<std::int32_t>(notice);
    EXPECT_EQ(flight_sample(record_, time_, DriveState::kEnabled, true).notices, notice);
  }
}

TEST_F(StateRecordTest, ShowsTheTargetToTheBitAsItWasOrdered) {
  enable();
  ordered_.accept({.joint_rad = 1.7500000001, .drive_rad = 0.75}, 0);
  EXPECT_EQ(filled().target_position_rad, 1.7500000001);
}

TEST_F(StateRecordTest, ShowsTheDrivesErrorOfNowUntilAFaultAndThenThatOfTheFault) {
  reading_.drive_error = 1;
  EXPECT_EQ(filled().drive_error, 1);
  (void)mode_.latch(Fault::kDriveFault, 2, 3);
  const state_v1& state = filled();
  EXPECT_EQ(state.drive_error, 2);
  EXPECT_EQ(state.fault, static_cast<int>(Fault::kDriveFault));
  EXPECT_EQ(state.mode, static_cast<int>(Mode::kFaulted));
  EXPECT_EQ(state.faults_total, 1);
}

TEST_F(StateRecordTest, HasTheCycleTheTableItsWeightsAndTheNotices) {
  const state_v1& state = filled();
  EXPECT_EQ(state.cycle, 42);
  EXPECT_EQ(state.table_id, 77);
  EXPECT_EQ(state.rule_count, 2);
  EXPECT_EQ(state.temperature_weights[1], 0.75);
  EXPECT_EQ(state.notices, 5);
}

TEST_F(StateRecordTest, TellsTheAgeOfTheTemperatureAndThatThereWasNone) {
  filled();
  EXPECT_EQ(record_.temperature_age_s, -1.0);
  EXPECT_TRUE(std::isnan(record_.state.temperature_used_C));
  EXPECT_TRUE(std::isnan(record_.temperature_measured_C));
  temperature_.update(true, 21.5, 1'000'000'000, time_.now_ns);
  filled();
  EXPECT_EQ(record_.state.temperature_used_C, 21.5);
  EXPECT_EQ(record_.temperature_measured_C, 21.5);
  EXPECT_DOUBLE_EQ(record_.temperature_age_s, 2.0);
}

TEST_F(StateRecordTest, AndTheFlightSampleSayTheSame) {
  enable();
  const state_v1& state = filled();
  const FlightSample sample = flight_sample(record_, time_, DriveState::kEnabled, true);
  EXPECT_EQ(sample.time_ns, time_.now_ns);
  EXPECT_EQ(sample.cycle, state.cycle);
  EXPECT_EQ(sample.setpoint_position_rad, state.setpoint_position_rad);
  EXPECT_EQ(sample.joint_position_rad, state.joint_position_rad);
  EXPECT_EQ(sample.torque_commanded_Nm, state.torque_commanded_Nm);
  EXPECT_EQ(sample.mode, state.mode);
  EXPECT_EQ(sample.notices, state.notices);
  EXPECT_EQ(sample.drive_state, 2);
  EXPECT_EQ(sample.reading_fresh, 1);
}

}  // namespace
}  // namespace strainwave
