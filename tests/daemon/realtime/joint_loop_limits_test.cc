// Limits and faults that no simulated drive shows by itself, on a drive that says whatever the test wants.
// Virtual time.
#include <gtest/gtest.h>

#include <limits>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

class ScriptedActuator final : public Actuator {
 public:
  ActuatorReading read(std::int64_t) noexcept override { return reading; }
  void write(const ActuatorCommand& command) noexcept override { last = command; }
  void stop() noexcept override {
    last = {};
    ++stops;
  }
  void clear_fault() noexcept override { reading.fault = ActuatorFault::kNone; }

  ActuatorReading reading;
  ActuatorCommand last;
  int stops = 0;
};

class JointLoopLimits : public ::testing::Test {
 protected:
  JointLoopLimits() {
    config_ = demo_joint().loop;
    config_.start_timeout_s = 0.1;
    config_.stop_timeout_s = 0.2;
    config_.missed_readings_limit = 5;
    make();
  }
  void make() {
    cycle_ = 0;
    auto drive = std::make_unique<ScriptedActuator>();
    drive_ = drive.get();
    drive_->reading.has_position = true;
    drive_->reading.has_temperature = true;
    drive_->reading.temperature_C = 25.0;
    loop_ = std::make_unique<JointLoop>(0, config_, std::move(drive), replies_, events_);
    loop_->table_slot(0) = {demo_table(), 1};
    order(OrderKind::kUseTable);
  }
  void step() {
    drive_->reading.joint_position_rad += drifting_rad_s_ * 0.001;
    const std::int64_t now_ns = 1'000'000'000 + ++cycle_ * 1'000'000;
    drive_->reading.temperature_produced_ns = now_ns;
    loop_->step({now_ns, cycle_});
  }
  /// Long enough to be seen not to move.
  void stand() {
    for (int i = 0; i < 200; ++i) step();
  }
  Reason order(OrderKind kind) {
    loop_->orders().push({1, kind, 0, 0.0, 0.0, {}});
    step();
    return replies_.pop(last_reply_) ? last_reply_.reason : Reason::kTimedOut;
  }
  void hold() {
    ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
    drive_->reading.drive_state = DriveState::kEnabled;
    step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding);
  }
  Fault fault() const { return static_cast<Fault>(loop_->record().state.fault); }
  /// Cycles until the fault, counting the first one as 1; 0 when none comes within `limit`.
  int cycles_until_fault(int limit) {
    for (int cycles = 1; cycles <= limit; ++cycles) {
      step();
      if (fault() != Fault::kNone) return cycles;
    }
    return 0;
  }

  ReplyQueue replies_;
  EventQueue events_;
  JointLoopConfig config_;
  ScriptedActuator* drive_ = nullptr;
  std::unique_ptr<JointLoop> loop_;
  Reply last_reply_;
  std::int64_t cycle_ = 0;
  double drifting_rad_s_ = 0.0;
};

TEST_F(JointLoopLimits, TurnEveryFaultOfTheDriveIntoTheJointsWithinOneCycle) {
  const std::pair<ActuatorFault, Fault> pairs[]{
      {ActuatorFault::kReadFailed, Fault::kReadFailed},
      {ActuatorFault::kWriteRefused, Fault::kWriteRefused},
      {ActuatorFault::kDriveFault, Fault::kDriveFault},
      {ActuatorFault::kPowerLost, Fault::kPowerLost},
      {ActuatorFault::kImplausible, Fault::kImplausibleReading},
      {ActuatorFault::kLinkLost, Fault::kLinkLost},
      {ActuatorFault::kEmergencyStop, Fault::kEmergencyStop},
      {ActuatorFault::kDriveRestarted, Fault::kDriveRestarted},
      {ActuatorFault::kBusError, Fault::kBusError},
  };
  for (const auto& [drive_fault, expected] : pairs) {
    drive_->reading.drive_state = DriveState::kDisabled;
    hold();
    drive_->reading.fault = drive_fault;
    EXPECT_EQ(cycles_until_fault(1), 1);
    EXPECT_EQ(fault(), expected);
    EXPECT_FALSE(drive_->last.enable);
    drive_->reading.drive_state = DriveState::kDisabled;
    ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
    EXPECT_EQ(loop_->mode(), Mode::kOff);
  }
}

TEST_F(JointLoopLimits, KeepTheDrivesOwnErrorNumberWithTheFaultThatItExplains) {
  hold();
  drive_->reading.fault = ActuatorFault::kDriveFault;
  drive_->reading.drive_error = 0x3210;
  step();
  drive_->reading.drive_error = 0x8130;  // what follows explains nothing
  step();
  EXPECT_EQ(loop_->record().state.drive_error, 0x3210);
  LoopEvent event;
  while (events_.pop(event) && event.to != Mode::kFaulted) continue;
  EXPECT_EQ(event.drive_error, 0x3210U);
}

TEST(JointLoopMissedReadings, DoNotDisturbAMotionAtFullSpeed) {
  for (const int missing : {1, 2, 3}) {
    JointBench bench({demo_joint()});
    bench.bring_to_hold(0);
    ASSERT_EQ(bench.move(0, 1.0), Reason::kAccepted);
    const double full_speed_rad_s = demo_joint().loop.controller.motion.velocity_rad_s;
    ASSERT_GE(
        bench.step_until([&] { return bench.state(0).joint_velocity_rad_s > 0.98 * full_speed_rad_s; }, 500),
        0);
    bench.drive(0).miss_readings(missing);
    bench.run(1.0);
    EXPECT_EQ(bench.fault(0), Fault::kNone) << missing << ": " << to_text(bench.fault(0));
    EXPECT_NEAR(bench.state(0).joint_position_rad, 1.0, 1e-4) << missing;
  }
}

TEST_F(JointLoopLimits, LetASilentDriveSayItsFaultWhenSomebodyEnablesIt) {
  hold();
  order(OrderKind::kDisable);
  while (loop_->mode() != Mode::kOff) step();
  drive_->reading.has_position = false;
  step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kDriveNotReady);
  drive_->reading.fault = ActuatorFault::kDriveRestarted;
  step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  EXPECT_EQ(fault(), Fault::kDriveRestarted);
  EXPECT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
}

TEST_F(JointLoopLimits, LeaveAReleasedEmergencyStopWithoutMotion) {
  hold();
  drive_->reading.fault = ActuatorFault::kEmergencyStop;
  step();
  drive_->reading.fault = ActuatorFault::kNone;
  drive_->reading.drive_state = DriveState::kDisabled;
  for (int i = 0; i < 5000; ++i) {
    step();
    ASSERT_EQ(loop_->mode(), Mode::kFaulted);
    ASSERT_FALSE(drive_->last.enable);
  }
}

TEST_F(JointLoopLimits, StopTheDriveAgainUntilItHasObeyed) {
  hold();
  drive_->reading.fault = ActuatorFault::kDriveFault;
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(drive_->stops, 10) << "the drive still says that it is enabled";
  drive_->reading.drive_state = DriveState::kDisabled;
  for (int i = 0; i < 10; ++i) step();
  EXPECT_EQ(drive_->stops, 10);
}

TEST_F(JointLoopLimits, TolerateAsManyMissedReadingsAsConfigured) {
  hold();
  drive_->reading.has_position = false;
  for (int i = 0; i < config_.missed_readings_limit; ++i) {
    step();
    EXPECT_EQ(fault(), Fault::kNone);
    EXPECT_NE(loop_->record().state.notices & static_cast<int>(Notice::kReadingMissed), 0);
  }
  step();
  EXPECT_EQ(fault(), Fault::kReadFailed);
}

TEST_F(JointLoopLimits, LatchTheStartTimeout) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  EXPECT_NEAR(cycles_until_fault(1000), 100, 1);
  EXPECT_EQ(fault(), Fault::kStartTimeout);
}

TEST_F(JointLoopLimits, LatchTheStopTimeout) {
  hold();
  drifting_rad_s_ = 0.2;  // the load drives it on, whatever the torque
  for (int i = 0; i < 50; ++i) step();
  ASSERT_EQ(fault(), Fault::kNone);
  ASSERT_EQ(order(OrderKind::kDisable), Reason::kAccepted);
  ASSERT_EQ(loop_->mode(), Mode::kStopping);
  EXPECT_NEAR(cycles_until_fault(1000), 200, 2);
  EXPECT_EQ(fault(), Fault::kStopTimeout);
}

TEST_F(JointLoopLimits, LatchThePositionLimit) {
  drive_->reading.joint_position_rad =
      config_.limits.position_max_rad + config_.limits.position_margin_rad - 0.001;
  stand();
  hold();
  step();
  EXPECT_EQ(fault(), Fault::kNone);
  drive_->reading.joint_position_rad += 0.002;
  EXPECT_EQ(cycles_until_fault(1), 1);
  EXPECT_EQ(fault(), Fault::kPositionLimit);
}

TEST_F(JointLoopLimits, LatchTheTemperatureLimitInOneCycleWhateverThePlausibility) {
  // Within the sensor's range but too sudden, just above the range, far above it.
  for (const double temperature_C : {85.0, 90.5, 200.0}) {
    drive_->reading.drive_state = DriveState::kDisabled;
    drive_->reading.temperature_C = 25.0;
    hold();
    drive_->reading.temperature_C = temperature_C;
    EXPECT_EQ(cycles_until_fault(1), 1) << temperature_C;
    EXPECT_EQ(fault(), Fault::kTemperatureLimit) << temperature_C;
    drive_->reading.drive_state = DriveState::kDisabled;
    ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
  }
}

TEST_F(JointLoopLimits, NeverLetATooHotJointBeControlled) {
  drive_->reading.temperature_C = 95.0;
  step();
  order(OrderKind::kEnable);
  EXPECT_EQ(loop_->mode(), Mode::kFaulted);
  EXPECT_EQ(fault(), Fault::kTemperatureLimit);
  EXPECT_FALSE(drive_->last.enable);
}

TEST_F(JointLoopLimits, MakeALossOfTemperatureAFaultWhereThatIsConfigured) {
  for (const bool loss_is_fault : {false, true}) {
    config_.temperature.loss_is_fault = loss_is_fault;
    config_.temperature.max_age_s = 0.1;
    make();
    hold();
    drive_->reading.has_temperature = false;
    const int cycles = cycles_until_fault(1000);
    if (loss_is_fault) {
      EXPECT_NEAR(cycles, 100, 2);
      EXPECT_EQ(fault(), Fault::kTemperatureLost);
    } else {
      EXPECT_EQ(cycles, 0);
      EXPECT_EQ(loop_->record().state.gains_in_use, static_cast<int>(GainsInUse::kFallback));
    }
  }
}

TEST_F(JointLoopLimits, RefuseToEnableAJointThatMovesAndSayHowFast) {
  drifting_rad_s_ = 3.6;
  for (int i = 0; i < 200; ++i) step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kMoving);
  EXPECT_NEAR(last_reply_.joint_velocity_rad_s, 3.6, 1e-6);
  EXPECT_EQ(loop_->mode(), Mode::kOff);
  EXPECT_FALSE(drive_->last.enable);
  drifting_rad_s_ = 0.0;
  stand();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
}

TEST_F(JointLoopLimits, BeginWithTheMotionThatTheJointHasWhenItsDriveBecomesReady) {
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drifting_rad_s_ = 0.5;  // somebody pushes it while the drive starts
  for (int i = 0; i < 90; ++i) step();
  drive_->reading.drive_state = DriveState::kEnabled;
  step();
  ASSERT_EQ(loop_->mode(), Mode::kHolding);
  const state_v1& first = loop_->record().state;
  EXPECT_NEAR(first.setpoint_velocity_rad_s, 0.5, 0.2) << "it comes to rest from there";
  EXPECT_NEAR(first.setpoint_position_rad, first.joint_position_rad, 1e-3);
}

TEST_F(JointLoopLimits, ShowTheControllersOwnSetpointFromTheFirstRecordOn) {
  drive_->reading.joint_position_rad = 1.25;
  stand();
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  drive_->reading.drive_state = DriveState::kEnabled;
  for (int i = 0; i < 5; ++i) {
    step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding);
    EXPECT_DOUBLE_EQ(loop_->record().state.setpoint_position_rad, 1.25) << i;
    EXPECT_DOUBLE_EQ(loop_->record().state.target_position_rad, 1.25) << i;
  }
}

TEST_F(JointLoopLimits, RefuseEveryOrderThatCouldMoveAJointWhileTheDaemonEnds) {
  hold();
  loop_->end({1'000'000'000 + (cycle_ + 1) * 1'000'000, cycle_ + 1});
  EXPECT_EQ(loop_->mode(), Mode::kStopping);
  EXPECT_EQ(order(OrderKind::kSetpoint), Reason::kEnding);
  EXPECT_EQ(order(OrderKind::kHome), Reason::kEnding);
  for (int i = 0; i < 100 && loop_->mode() != Mode::kOff; ++i) step();
  ASSERT_EQ(loop_->mode(), Mode::kOff);
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kEnding);
  EXPECT_EQ(loop_->mode(), Mode::kOff);
}

TEST_F(JointLoopLimits, RefuseNumbersThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (double ActuatorReading::*field :
       {&ActuatorReading::joint_position_rad, &ActuatorReading::torque_applied_Nm}) {
    drive_->reading.drive_state = DriveState::kDisabled;
    hold();
    drive_->reading.*field = nan;
    EXPECT_EQ(cycles_until_fault(1), 1);
    EXPECT_EQ(fault(), Fault::kImplausibleReading);
    drive_->reading.*field = 0.0;
    drive_->reading.drive_state = DriveState::kDisabled;
    ASSERT_EQ(order(OrderKind::kClearFault), Reason::kAccepted);
  }
}

TEST_F(JointLoopLimits, LeaveAJointThatIsOffAloneWhateverItsDriveSays) {
  drive_->reading.fault = ActuatorFault::kPowerLost;
  drive_->reading.joint_position_rad = 100.0;
  for (int i = 0; i < 100; ++i) step();
  EXPECT_EQ(loop_->mode(), Mode::kOff);
  drive_->reading.has_position = false;
  drive_->reading.fault = ActuatorFault::kNone;
  step();
  EXPECT_EQ(order(OrderKind::kEnable), Reason::kDriveNotReady);
}

TEST_F(JointLoopLimits, ShowTheFirstOfSeveralFaults) {
  hold();
  drive_->reading.fault = ActuatorFault::kPowerLost;
  step();
  drive_->reading.fault = ActuatorFault::kLinkLost;
  drive_->reading.joint_position_rad = 50.0;
  step();
  EXPECT_EQ(fault(), Fault::kPowerLost);
  EXPECT_EQ(loop_->record().state.faults_total, 1);
}

}  // namespace
}  // namespace strainwave::testing
