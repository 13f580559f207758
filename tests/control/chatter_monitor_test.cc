#include "control/chatter_monitor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace strainwave {
namespace {

constexpr double kStatic_Nm = 2.0;

ChatterSample sample_with(double excess_Nm) {
  ChatterSample sample;
  sample.excess_torque_Nm = excess_Nm;
  sample.static_friction_Nm = kStatic_Nm;
  return sample;
}

/// Periods of 1 ms until the state is `wanted`, or -1.
int periods_until(ChatterMonitor& monitor, MonitorState wanted, double frequency_Hz, double amplitude_Nm,
                  int limit, bool rests = false) {
  for (int k = 0; k < limit; ++k) {
    ChatterSample sample = sample_with(amplitude_Nm * std::sin(2e-3 * std::numbers::pi * frequency_Hz * k));
    sample.reference_rests = rests;
    if (monitor.step(sample) == wanted) return k;
  }
  return -1;
}

TEST(ChatterMonitor, SeesASwingingSpringWithin50msAndWantsItOffWithinHalfASecond) {
  for (const double frequency_Hz : {45.0, 55.0, 86.0, 150.0, 250.0}) {
    ChatterMonitor monitor(0.001);
    const int fallback = periods_until(monitor, MonitorState::kFallenBack, frequency_Hz, 20.0, 1000);
    EXPECT_GE(fallback, 0) << frequency_Hz;
    EXPECT_LE(fallback, 50) << frequency_Hz;
    const int fault = periods_until(monitor, MonitorState::kFaultDue, frequency_Hz, 20.0, 1000);
    EXPECT_GE(fault, 200) << frequency_Hz;
    EXPECT_LE(fallback + fault, 500) << frequency_Hz;
  }
}

TEST(ChatterMonitor, TakesWhatTheLawsFrictionCompensationMakesForNoneWhileTheReferenceMoves) {
  ChatterMonitor monitor(0.001);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> noise(-2.4 * kStatic_Nm, 2.4 * kStatic_Nm);
  for (int k = 0; k < 20000; ++k)
    ASSERT_EQ(monitor.step(sample_with(noise(random))), MonitorState::kWatching);
}

TEST(ChatterMonitor, LetsALandingReverseWhereItWouldTakeTheLawForChattering) {
  const auto after_five_reversals = [](bool landing) {
    ChatterMonitor monitor(0.001);
    MonitorState state = MonitorState::kWatching;
    for (int k = 0; k < 60; ++k) {
      ChatterSample sample = sample_with(k / 10 % 2 == 0 ? 20.0 : -20.0);
      sample.landing = landing;
      sample.surprised = true;
      state = monitor.step(sample);
    }
    return state;
  };
  EXPECT_EQ(after_five_reversals(true), MonitorState::kWatching);
  EXPECT_EQ(after_five_reversals(false), MonitorState::kFallenBack);
}

TEST(ChatterMonitor, SeesAtRestWhatIsTooWeakToBeSeenInMotionAndNeverWhatCannotMoveTheJoint) {
  for (const double amplitude_Nm : {0.9, 2.0}) {
    ChatterMonitor monitor(0.001);
    EXPECT_LT(periods_until(monitor, MonitorState::kFallenBack, 50.0, amplitude_Nm, 5000), 0);
    monitor.reset();
    EXPECT_EQ(periods_until(monitor, MonitorState::kFallenBack, 50.0, amplitude_Nm, 5000, true) >= 0,
              amplitude_Nm > 1.0);
  }
}

TEST(ChatterMonitor, SeesASlowSwingAboutTheTargetThatGoesOnLongAfterTheReferenceHasComeToRest) {
  for (const double frequency_Hz : {9.0, 14.0, 20.0}) {
    ChatterMonitor monitor(0.001);
    const int seen = periods_until(monitor, MonitorState::kFallenBack, frequency_Hz, 2.4, 10000, true);
    EXPECT_GT(seen, 2000) << frequency_Hz << ": a joint may hunt for a while";
    EXPECT_LT(seen, 6000) << frequency_Hz;
  }
  ChatterMonitor pushed(0.001);
  EXPECT_LT(periods_until(pushed, MonitorState::kFallenBack, 3.0, 2.4, 60000, true), 0) << "by somebody";
  ChatterMonitor moving(0.001);
  EXPECT_LT(periods_until(moving, MonitorState::kFallenBack, 14.0, 2.4, 60000), 0);
}

TEST(ChatterMonitor, TakesWhatACoarseEncoderMakesOfTheTorqueForNoise) {
  ChatterMonitor monitor(0.001);
  for (int k = 0; k < 20000; ++k) {
    ChatterSample sample = sample_with(k % 2 == 0 ? 5.0 : -5.0);
    sample.feedback_step_Nm = 2.0;
    ASSERT_EQ(monitor.step(sample), MonitorState::kWatching);
  }
}

TEST(ChatterMonitor, IsSilentHoweverLongAndHardThePushInOneDirection) {
  ChatterMonitor monitor(0.001);
  for (int k = 0; k < 100000; ++k) ASSERT_EQ(monitor.step(sample_with(34.0)), MonitorState::kWatching);
}

TEST(ChatterMonitor, LetsThePushesOfALandingReverseAsLongAsTheEncoderAgrees) {
  for (const bool surprised : {false, true}) {
    ChatterMonitor monitor(0.001);
    for (int k = 0; k < 400; ++k) {
      ChatterSample sample = sample_with(k % 2 == 0 ? 20.0 : -20.0);
      sample.landing = true;
      sample.surprised = surprised;
      monitor.step(sample);
    }
    EXPECT_EQ(monitor.state() != MonitorState::kWatching, surprised);
  }
}

TEST(ChatterMonitor, LeavesAJointInTheFallbackThatHasBecomeQuiet) {
  ChatterMonitor monitor(0.001);
  ASSERT_GE(periods_until(monitor, MonitorState::kFallenBack, 60.0, 20.0, 100), 0);
  for (int k = 0; k < 60000; ++k) ASSERT_EQ(monitor.step(sample_with(1.0)), MonitorState::kFallenBack);
  EXPECT_GE(periods_until(monitor, MonitorState::kFaultDue, 60.0, 20.0, 1000), 0) << "for ever";
  monitor.reset();
  EXPECT_EQ(monitor.state(), MonitorState::kWatching);
}

TEST(ChatterMonitor, IsNotMovedByATorqueThatIsNoNumber) {
  ChatterMonitor monitor(0.001);
  for (int k = 0; k < 1000; ++k)
    ASSERT_EQ(monitor.step(sample_with(k % 2 == 0 ? std::nan("") : 20.0)), MonitorState::kWatching);
}

}  // namespace
}  // namespace strainwave
