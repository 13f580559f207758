// Above 300 lines: one small object, and a case for each way of shaking that it knows.
#include "control/chatter_monitor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace strainwave {
namespace {

constexpr double kStatic_Nm = 2.0;

ChatterSample sample_with(double torque_Nm, double planned_Nm = 0.0) {
  ChatterSample sample;
  sample.torque_Nm = torque_Nm;
  sample.planned_torque_Nm = planned_Nm;
  sample.static_friction_Nm = kStatic_Nm;
  sample.torque_limit_Nm = 34.0;
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

// As of a joint that gives way before it slides: less than half of static friction, about a load of which nobody knows.
TEST(ChatterMonitor, SeesAHumAtRestAboutWhateverLoadWithinASecondAndNoHandThatRocksTheJoint) {
  for (const bool follows_model : {false, true})
    for (const double load_Nm : {0.0, 1.9, 15.0}) {
      const auto fallback_s = [&](double swings_per_s) {
        ChatterMonitor monitor(0.001);
        for (int k = 0; k < 4000; ++k) {
          ChatterSample sample;
          sample.static_friction_Nm = 4.0;
          sample.torque_limit_Nm = 34.0;
          sample.reference_rests = true;
          sample.follows_model = follows_model;
          sample.torque_Nm = load_Nm + 1.8 * std::sin(2.0 * std::numbers::pi * swings_per_s * 1e-3 * k);
          if (monitor.step(sample) != MonitorState::kWatching) return 1e-3 * k;
        }
        return 1e9;
      };
      EXPECT_LT(fallback_s(130.0), 1.0) << load_Nm;
      EXPECT_LT(fallback_s(40.0), 1.9) << load_Nm;
      EXPECT_GT(fallback_s(10.0), 1e3) << load_Nm;
    }
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
    ASSERT_EQ(monitor.step(sample_with(10.0 + noise(random), 10.0)), MonitorState::kWatching);
}

/// Periods of 1 ms until the fallback where a plan needs all of the torque and the torque swings between that and as much against it.
int periods_until_fallback(double frequency_Hz, const std::function<double(int)>& planned_Nm,
                           double lowest_Nm) {
  ChatterMonitor monitor(0.001);
  for (int k = 0; k < 1000; ++k) {
    const double now_Nm = planned_Nm(k);
    const bool against = std::sin(2e-3 * std::numbers::pi * frequency_Hz * k) < 0.0;
    const double torque_Nm = against ? std::copysign(lowest_Nm, -now_Nm) : now_Nm;
    if (monitor.step(sample_with(torque_Nm, now_Nm)) != MonitorState::kWatching) return k;
  }
  return -1;
}

TEST(ChatterMonitor, SeesWithin50msATorqueThatReversesWhereThePlanLeavesNothingBeyondIt) {
  for (const double frequency_Hz : {55.0, 86.0, 112.0, 160.0, 250.0}) {
    const int seen = periods_until_fallback(
        frequency_Hz, [](int) { return 34.0; }, 34.0);
    EXPECT_GE(seen, 0) << frequency_Hz;
    EXPECT_LE(seen, 50) << frequency_Hz;
  }
  EXPECT_LT(periods_until_fallback(
                112.0, [](int) { return 34.0; }, 1.4 * kStatic_Nm),
            0)
      << "less than moves the joint";
}

TEST(ChatterMonitor, TakesReversalsThatThePlanOrdersForNoneHoweverFast) {
  for (const double frequency_Hz : {0.5, 5.0, 20.0, 60.0})
    for (const int late_periods : {0, 1, 4}) {
      ChatterMonitor monitor(0.001);
      const auto planned_Nm = [&](int k) {
        return 30.0 * std::sin(2e-3 * std::numbers::pi * frequency_Hz * k);
      };
      for (int k = late_periods; k < 20000; ++k) {
        const double excess_Nm = std::clamp(planned_Nm(k - late_periods) - planned_Nm(k), -4.0, 4.0);
        ASSERT_EQ(monitor.step(sample_with(planned_Nm(k) + excess_Nm, planned_Nm(k))),
                  MonitorState::kWatching)
            << frequency_Hz << " Hz, " << late_periods << " periods late, at " << k;
      }
    }
}

// As small motions of a heavy link do: the torque just beyond the threshold, and the plan just within, by what the feedback adds.
TEST(ChatterMonitor, TakesReversalsThatThePlanOrdersForNoneWhereFeedbackAloneBringsThemBeyondTheThreshold) {
  const auto falls_back = [](double planned_Nm) {
    ChatterMonitor monitor(0.001);
    for (int k = 0; k < 1000; ++k) {
      const double side = k / 5 % 2 == 0 ? 1.0 : -1.0;
      ChatterSample sample = sample_with(side * 1.05 * (7.0 + 1.5 * kStatic_Nm), side * planned_Nm);
      sample.doubt_Nm = 7.0;
      if (monitor.step(sample) != MonitorState::kWatching) return true;
    }
    return false;
  };
  for (const double planned_Nm : {0.95, 0.6}) EXPECT_FALSE(falls_back(planned_Nm * 10.0)) << planned_Nm;
  EXPECT_TRUE(falls_back(0.4 * 10.0)) << "most of it is not ordered";
  EXPECT_TRUE(falls_back(-0.95 * 10.0)) << "ordered to the other side";
}

TEST(ChatterMonitor, GivesAPlanThatRestsOnWhatItWasToldItsDoubt) {
  for (const double doubt_Nm : {0.0, 7.0}) {
    ChatterMonitor monitor(0.001);
    for (int k = 0; k < 1000; ++k) {
      ChatterSample sample = sample_with(k / 5 % 2 == 0 ? 8.0 : -8.0);
      sample.doubt_Nm = doubt_Nm;
      monitor.step(sample);
    }
    EXPECT_EQ(monitor.state() == MonitorState::kWatching, doubt_Nm > 0.0);
  }
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
  // A quarter of static friction moves no joint, however it creeps before it slides; half of it one that does not creep.
  for (const double amplitude_Nm : {0.45, 0.9, 2.0}) {
    ChatterMonitor monitor(0.001);
    EXPECT_LT(periods_until(monitor, MonitorState::kFallenBack, 50.0, amplitude_Nm, 5000), 0);
    monitor.reset();
    EXPECT_EQ(periods_until(monitor, MonitorState::kFallenBack, 50.0, amplitude_Nm, 5000, true) >= 0,
              amplitude_Nm > 0.5);
  }
}

TEST(ChatterMonitor, SeesASlowSwingAboutTheTargetThatGoesOnAfterTheReferenceHasComeToRest) {
  for (const double frequency_Hz : {9.0, 14.0, 20.0}) {
    ChatterMonitor monitor(0.001);
    const int seen = periods_until(monitor, MonitorState::kFallenBack, frequency_Hz, 2.4, 10000, true);
    EXPECT_GT(seen, 500) << frequency_Hz << ": a joint may hunt for a while";
    EXPECT_LT(seen, 2000) << frequency_Hz;
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

TEST(ChatterMonitor, TakesNoReversalOfTheWholeTorqueForNoiseHoweverCoarseTheEncoder) {
  ChatterMonitor monitor(0.001);
  MonitorState state = MonitorState::kWatching;
  for (int k = 0; k < 50; ++k) {
    ChatterSample sample = sample_with(k / 2 % 2 == 0 ? 34.0 : -34.0);
    sample.feedback_step_Nm = 20.0;
    state = monitor.step(sample);
  }
  EXPECT_EQ(state, MonitorState::kFallenBack);
}

TEST(ChatterMonitor, DistrustsAModelWhoseInnovationAsksForHalfOfTheTorqueAndNoneThatAsksForLess) {
  for (const double share : {0.45, 0.8, 5.0}) {
    ChatterMonitor monitor(0.001);
    int fallback = -1;
    for (int k = 0; k < 1000 && fallback < 0; ++k) {
      ChatterSample sample = sample_with(0.0);
      sample.innovation_Nm = (k / 20 % 2 == 0 ? 34.0 : -34.0) * share;
      if (monitor.step(sample) != MonitorState::kWatching) fallback = k;
    }
    if (share < 0.5) {
      EXPECT_LT(fallback, 0);
    } else {
      EXPECT_GE(fallback, 0) << share;
      EXPECT_LE(fallback, 50) << share;
    }
  }
}

TEST(ChatterMonitor, TakesLessForChatterWhereTheLawCompensatesNoFriction) {
  for (const bool compensates : {false, true}) {
    ChatterMonitor monitor(0.001);
    MonitorState state = MonitorState::kWatching;
    for (int k = 0; k < 100; ++k) {
      ChatterSample sample = sample_with((k / 7 % 2 == 0 ? 1.4 : -1.4) * kStatic_Nm);
      sample.compensates_friction = compensates;
      state = monitor.step(sample);
    }
    EXPECT_EQ(state != MonitorState::kWatching, !compensates);
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

/// Periods of 1 ms until a joint that comes over its place every so many falls back; -1: it does not.
int periods_until_it_drives_itself(int every, bool compensates, double rests_s) {
  ChatterMonitor monitor(0.001);
  for (int k = 0; k < 5000; ++k) {
    ChatterSample sample = sample_with(0.0);
    sample.reference_rests = 1e-3 * k < rests_s;
    sample.compensates_friction = compensates;
    sample.swung_over = k % every == 0;
    if (monitor.step(sample) != MonitorState::kWatching) return monitor.drives_itself() ? k : -2;
  }
  return -1;
}

TEST(ChatterMonitor, SeesWithin50msOfTheSecondSwingThatCompensatedFrictionDrivesTheJoint) {
  for (const int every : {12, 24, 48}) {
    const int seen = periods_until_it_drives_itself(every, true, 5.0);
    EXPECT_GT(seen, 100) << every << ": what comes to rest may swing";
    EXPECT_LE(seen, 100 + 2 * every) << every;
  }
  EXPECT_EQ(periods_until_it_drives_itself(24, false, 5.0), -1) << "none is compensated";
  EXPECT_EQ(periods_until_it_drives_itself(24, true, 0.05), -1) << "it moves";
  EXPECT_EQ(periods_until_it_drives_itself(200, true, 5.0), -1) << "somebody pushes it";
}

TEST(ChatterMonitor, TakesNoMoreThanOrdersThatSwingTheJointExplainForTheirs) {
  const auto seen = [](double excess_Nm, double ordered_Nm, int ordered_for) {
    ChatterMonitor monitor(0.001);
    for (int k = 0; k < 2000; ++k) {
      ChatterSample sample = sample_with(excess_Nm * std::sin(2e-3 * std::numbers::pi * 50.0 * k));
      if (k < 100) sample.torque_Nm = 0.0;
      if (k < ordered_for) sample.ordered_torque_Nm = k / 25 % 2 == 0 ? ordered_Nm : -ordered_Nm;
      sample.planned_torque_Nm = sample.ordered_torque_Nm;
      sample.torque_Nm += sample.planned_torque_Nm;
      if (monitor.step(sample) != MonitorState::kWatching) return k;
    }
    return -1;
  };
  EXPECT_GE(seen(9.0, 0.0, 2000), 100);
  EXPECT_EQ(seen(9.0, 6.0, 2000), -1) << "the swing of what it carries";
  EXPECT_LT(seen(20.0, 6.0, 2000), 160) << "more than the orders make";
  EXPECT_GE(seen(9.0, 6.0, 1000), 1000);
  EXPECT_LT(seen(9.0, 6.0, 1000), 1300) << "it goes on after them";
}

// At rest a flickering count makes no velocity any more: what is as strong as a count's is the joint's.
TEST(ChatterMonitor, SeesAtRestWhatIsAsStrongAsOneCountOfACoarseEncoder) {
  for (const double step_Nm : {2.0, 3.0, 8.0}) {
    ChatterMonitor monitor(0.001);
    int fallback = -1;
    for (int k = 0; k < 3000 && fallback < 0; ++k) {
      ChatterSample sample = sample_with(k % 9 < 4 ? 0.0 : k % 18 < 9 ? step_Nm : -step_Nm);
      sample.feedback_step_Nm = step_Nm;
      sample.reference_rests = true;
      if (monitor.step(sample) == MonitorState::kFallenBack) fallback = k;
    }
    // 8 N.m move the joint.
    EXPECT_GE(fallback, step_Nm < 5.0 ? 200 : 120)
        << step_Nm << ": a joint that comes to rest may hunt so long";
    EXPECT_LE(fallback, step_Nm < 5.0 ? 300 : 200) << step_Nm;
  }
}

// The plain law is in doubt from half of its patience on; where the joint rests, which needs no stiffness, at once.
TEST(ChatterMonitor, DoubtsTheGainsAtOnceOfAJointThatChattersWhereItIsToRest) {
  for (const bool rests : {true, false}) {
    ChatterMonitor monitor(0.001);
    ASSERT_GE(periods_until(monitor, MonitorState::kFallenBack, 50.0, 20.0, 2000, rests), 0);
    EXPECT_EQ(monitor.goes_on(), false) << "chatter from the start is seen before the joint has rested";
    monitor.reset();
    ASSERT_GE(periods_until(monitor, MonitorState::kFallenBack, 50.0, 2.4, 2000, rests), rests ? 0 : -1);
    EXPECT_EQ(monitor.goes_on(), rests);
    if (!rests) continue;
    EXPECT_LT(periods_until(monitor, MonitorState::kFaultDue, 1.0, 0.1, 2000, true), 0) << "it has ended";
    EXPECT_GE(periods_until(monitor, MonitorState::kFaultDue, 50.0, 20.0, 1000, true), 0) << "it goes on";
  }
}

// A knock leaves swings, and who follows a model of the spring answers each.
TEST(ChatterMonitor, LetsAJointThatFollowsAModelOfItsSpringAnswerTheSwingsThatAKnockLeaves) {
  for (const bool follows_model : {false, true}) {
    ChatterMonitor monitor(0.001);
    bool watching = true;
    for (int k = 0; k < 600; ++k) {
      ChatterSample sample =
          sample_with(4.4 * std::exp(-2e-3 * k) * std::sin(2e-3 * std::numbers::pi * 35.0 * k));
      sample.reference_rests = true;
      sample.follows_model = follows_model;
      watching = watching && monitor.step(sample) == MonitorState::kWatching;
    }
    EXPECT_EQ(watching, follows_model);
  }
}

// Torques that move the joint whichever way, at rest: too few in a second for what may hunt, too weak for the counts of a coarse encoder.
TEST(ChatterMonitor, SeesWithinAThirdOfASecondATorqueThatMovesAJointToAndFroWhereItIsToRest) {
  for (const double frequency_Hz : {10.0, 16.0, 24.0, 45.0}) {
    const auto fallback = [&](double amplitude_Nm, bool rests) {
      ChatterMonitor monitor(0.001);
      for (int k = 0; k < 3000; ++k) {
        ChatterSample sample =
            sample_with(amplitude_Nm * std::sin(2e-3 * std::numbers::pi * frequency_Hz * k));
        sample.feedback_step_Nm = 5.0;
        sample.reference_rests = rests;
        if (monitor.step(sample) == MonitorState::kFallenBack) return k;
      }
      return -1;
    };
    EXPECT_LE(fallback(4.5, true), 0.1e3 + 3.2e3 / frequency_Hz) << frequency_Hz;
    EXPECT_GE(fallback(4.5, true), 120) << frequency_Hz << ": a motion's last swings";
    EXPECT_EQ(fallback(4.5, false), -1) << frequency_Hz << ": what the counts make of a motion";
  }
}

}  // namespace
}  // namespace strainwave
