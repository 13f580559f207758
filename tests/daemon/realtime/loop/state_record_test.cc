// SPDX-License-Identifier: BSD-3-Clause
// Fields of a record that no other test of the loop checks. Virtual time.
#include "daemon/realtime/loop/state_record.h"

#include <cmath>

#include "tests/daemon/realtime/joint/scripted_joint.h"

namespace strainwave::testing {
namespace {

class StateRecordTest : public ScriptedJoint {
 protected:
  const state_v1& stepped() {
    step();
    return loop_->record().state;
  }
};

TEST_F(StateRecordTest, ShowsTheMeasuredPlaceAsSetpointAndTargetWhileNothingIsControlled) {
  drive_->reading.joint_position_rad = 0.5;
  drive_->reading.torque_applied_Nm = 3.0;
  drive_->reading.has_velocity = true;
  drive_->reading.joint_velocity_rad_s = 0.15;
  const state_v1& state = stepped();
  EXPECT_EQ(state.setpoint_position_rad, 0.5);
  EXPECT_EQ(state.target_position_rad, 0.5);
  EXPECT_EQ(state.setpoint_velocity_rad_s, 0.0);
  EXPECT_EQ(state.joint_velocity_rad_s, 0.15) << "a joint may coast";
  EXPECT_EQ(state.torque_commanded_Nm, 0.0);
  EXPECT_EQ(state.torque_applied_Nm, 3.0);
}

TEST_F(StateRecordTest, ShowsTheLinkAndNoNumberWhereNothingMeasuresIt) {
  drive_->reading.link_position_rad = 0.25;
  EXPECT_TRUE(std::isnan(stepped().link_position_rad));
  drive_->reading.has_link_position = true;
  EXPECT_EQ(stepped().link_position_rad, 0.25);
}

TEST_F(StateRecordTest, GivesTheFlightSampleTheSame) {
  hold();
  StateRecord record = loop_->record();
  EXPECT_EQ(record.state.table_id, 1);
  EXPECT_EQ(record.state.rule_count, demo_table().friction.rule_count);
  record.state.notices = -1;
  const FlightSample sample = flight_sample(record, {7, record.state.cycle}, DriveState::kEnabled, true);
  EXPECT_EQ(sample.time_ns, 7);
  EXPECT_EQ(sample.cycle, record.state.cycle);
  EXPECT_EQ(sample.setpoint_position_rad, record.state.setpoint_position_rad);
  EXPECT_EQ(sample.joint_position_rad, record.state.joint_position_rad);
  EXPECT_EQ(sample.torque_commanded_Nm, record.state.torque_commanded_Nm);
  EXPECT_EQ(sample.temperature_measured_C, 25.0);
  EXPECT_EQ(sample.mode, record.state.mode);
  EXPECT_EQ(sample.notices, 0xFFFFFFFFU) << "every notice";
  EXPECT_EQ(sample.drive_state, 2);
  EXPECT_EQ(sample.reading_fresh, 1);
}

}  // namespace
}  // namespace strainwave::testing
