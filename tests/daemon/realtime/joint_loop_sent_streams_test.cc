// A sine of 0.5 rad and 0.5 Hz in positions that are not stamped, 50 a second, over a network that does all that networks do, from a timer that is
// late: told when they were sent, not told, and now and then. Where the joint is, in virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "tests/support/flexible_bench.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kSentOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kSentAmplitude_rad = 0.5;
constexpr int kSentEvery = 20;    // periods
constexpr int kSentBegin = 2000;  // periods until the motion is judged
constexpr int kSentEnd = 8000;
// An interval, half of one until a sample is missed, and the bridge: after a longer silence the joint comes to rest.
constexpr int kBridged = 80;
constexpr double kSentTurning_rad_s = 0.3;
constexpr std::int64_t kSentEpoch_us = 1'700'000'000'000'000;
constexpr std::int64_t kHour_us = 3'600'000'000;

/// Of which samples it is told when they were sent; or of all, by a clock that is set an hour on or back every fifteen samples, or that stands.
enum class Telling { kAll, kNone, kEverySecond, kAnyOther, kAtFirst, kClockSet, kClockStands };

struct SentSample {
  int comes = 0;             ///< period
  int sent = 0;              ///< period, and what it is for
  std::int64_t told_us = 0;  ///< 0: not
};

/// A tenth is lost, two in a row at most, a twentieth swapped, none comes for 30 ms twice a second and for 50 ms every 0.9 s; those come
/// then all at once. Of what is not newer than what came before, admission passes nothing on: no doubles either. The timer
/// is late by up to 19 ms 2 % of the times.
std::vector<SentSample> sent_samples(Telling telling, bool timer_late, unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&] { return std::generate_canonical<double, 32>(random); };
  const auto told = [&](int i) {
    const double any = chance();
    switch (telling) {
      case Telling::kAll:
      case Telling::kClockSet:
      case Telling::kClockStands:
        return true;
      case Telling::kNone:
        return false;
      case Telling::kEverySecond:
        return i % 2 == 0;
      case Telling::kAnyOther:
        return any < 0.5;
      case Telling::kAtFirst:
        return i < 175;
    }
    return false;
  };
  std::vector<SentSample> sent;
  int missing = 0;
  bool swapped = false;
  for (int i = 0; i < kSentEnd / kSentEvery; ++i) {
    const bool late = chance() < 0.02;
    const int late_by = static_cast<int>(20.0 * chance());
    const bool is_told = told(i);
    SentSample one{0, i * kSentEvery, 0};
    if (i > 50 && late && timer_late) one.sent += std::min(late_by, kSentEvery - 1);
    if (is_told)
      one.told_us = kSentEpoch_us + (telling == Telling::kClockStands ? 0 : 1000 * std::int64_t{one.sent});
    if (telling == Telling::kClockSet && i / 15 % 2 == 1) one.told_us += kHour_us;
    one.comes = one.sent;
    const bool gap = one.sent % 500 >= 200 && one.sent % 500 < 230;
    const bool lost = chance() < 0.1 || gap;
    swapped = chance() < 0.05 && !swapped && missing < 2;
    if (i > 50) {
      missing = lost && missing < 2 ? missing + 1 : 0;
      if (missing > 0) continue;
      if (one.comes % 907 < 50) one.comes += 50 - one.comes % 907;
      if (swapped) one.comes = std::max(one.comes, one.sent + kSentEvery + 1);
      missing = swapped ? 1 : 0;
    }
    sent.push_back(one);
  }
  std::stable_sort(sent.begin(), sent.end(),
                   [](const SentSample& a, const SentSample& b) { return a.comes < b.comes; });
  int newest = -1;
  std::erase_if(sent, [&](const SentSample& one) {
    const bool older = one.sent <= newest;
    newest = std::max(newest, one.sent);
    return older;
  });
  return sent;
}

bool silence_outlasts_bridge(const std::vector<SentSample>& samples) {
  for (std::size_t i = 1; i < samples.size(); ++i)
    if (samples[i].comes - samples[i - 1].sent >= kBridged) return true;
  return false;
}

struct SentRide {
  double largest_error_rad = 0.0;  ///< of the link, from the sine an interval ago
  double largest_step_Nm = 0.0;    ///< in a period, while the joint does not turn round
  double largest_jerk_rad_s3 = 0.0;
};

SentRide sent_ride(const std::vector<SentSample>& samples, bool flexible, double jerk_limit_rad_s3 = 0.0) {
  BenchJoint joint = flexible ? flexible_joint() : demo_joint();
  if (jerk_limit_rad_s3 > 0.0) {
    joint.loop.controller.jerk_limit_rad_s3 = jerk_limit_rad_s3;
    joint.loop.controller.motion.acceleration_rad_s2 = 20.0;
    joint.loop.controller.motion.deceleration_rad_s2 = 20.0;
  }
  JointBench bench({joint});
  bench.bring_to_hold(0, flexible ? flexible_table() : demo_table());
  SentRide result;
  double last_Nm = 0.0, last_rad_s = 0.0, last_rad_s2 = 0.0;
  std::size_t next = 0;
  for (int k = 0; k < kSentEnd; ++k) {
    for (; next < samples.size() && samples[next].comes <= k; ++next) {
      Order order;
      order.kind = OrderKind::kSetpoint;
      order.stream_id = 1;
      order.begins_stream = next == 0;
      order.valid_for_s = 0.2;
      order.position_rad = kSentAmplitude_rad * std::sin(kSentOmega_rad_s * 1e-3 * samples[next].sent);
      order.sent_us = samples[next].told_us;
      EXPECT_TRUE(bench.joint(0).orders().push(order));
    }
    bench.step();
    const state_v1& state = bench.state(0);
    const double rad_s2 = (state.setpoint_velocity_rad_s - last_rad_s) / 1e-3;
    if (k >= 2)
      result.largest_jerk_rad_s3 =
          std::max(result.largest_jerk_rad_s3, std::abs(rad_s2 - last_rad_s2) / 1e-3);
    if (k >= kSentBegin) {
      const double link_rad = bench.drive(0).simulated().plant().link_state().position_rad;
      const double sine_rad = kSentAmplitude_rad * std::sin(kSentOmega_rad_s * 1e-3 * (k - kSentEvery));
      result.largest_error_rad = std::max(result.largest_error_rad, std::abs(link_rad - sine_rad));
      if (std::abs(state.setpoint_velocity_rad_s) > kSentTurning_rad_s)
        result.largest_step_Nm =
            std::max(result.largest_step_Nm, std::abs(state.torque_commanded_Nm - last_Nm));
    }
    last_Nm = state.torque_commanded_Nm;
    last_rad_s = state.setpoint_velocity_rad_s;
    last_rad_s2 = rad_s2;
  }
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  return result;
}

/// The worst of some rides in which no silence is longer than is bridged.
SentRide worst_ride(Telling telling, bool timer_late, bool flexible, double jerk_limit_rad_s3 = 0.0) {
  SentRide worst;
  int rides = 0;
  for (unsigned seed = 1; seed <= 100 && rides < 8; ++seed) {
    const std::vector<SentSample> samples = sent_samples(telling, timer_late, seed);
    if (silence_outlasts_bridge(samples)) continue;
    ++rides;
    const SentRide one = sent_ride(samples, flexible, jerk_limit_rad_s3);
    worst.largest_error_rad = std::max(worst.largest_error_rad, one.largest_error_rad);
    worst.largest_step_Nm = std::max(worst.largest_step_Nm, one.largest_step_Nm);
    worst.largest_jerk_rad_s3 = std::max(worst.largest_jerk_rad_s3, one.largest_jerk_rad_s3);
  }
  EXPECT_EQ(rides, 8);
  std::printf("told %d, timer %s, %s: error %.1f mrad, step %.2f N.m, jerk %.0f rad/s3\n",
              static_cast<int>(telling), timer_late ? "late" : "on time", flexible ? "spring" : "rigid ",
              1e3 * worst.largest_error_rad, worst.largest_step_Nm, worst.largest_jerk_rad_s3);
  return worst;
}

TEST(JointLoopSentStreams, AreWhereTheirSenderWasIfToldWhenTheyWereSentAndOnlyThen) {
  for (const bool flexible : {false, true}) {
    EXPECT_LT(worst_ride(Telling::kAll, true, flexible).largest_error_rad, 5e-3) << flexible;
    EXPECT_GT(worst_ride(Telling::kNone, true, flexible).largest_error_rad, 1e-2) << flexible;
  }
}

constexpr Telling kMixed[] = {Telling::kEverySecond, Telling::kAnyOther, Telling::kAtFirst};

// As those that nobody tells of: not where the timer is late.
TEST(JointLoopSentStreams, AreWhereTheirSenderWasIfToldOfSomeAndTheTimerIsOnTime) {
  for (const bool flexible : {false, true}) {
    const double told_step_Nm = worst_ride(Telling::kAll, false, flexible).largest_step_Nm;
    for (const Telling telling : kMixed) {
      const SentRide worst = worst_ride(telling, false, flexible);
      EXPECT_LT(worst.largest_error_rad, 5e-3) << flexible;
      EXPECT_LT(worst.largest_step_Nm, told_step_Nm + 1.0) << flexible;
    }
  }
}

// The sample that shows that the clock was set is taken for when it came, and by a clock that stands nothing is told.
TEST(JointLoopSentStreams, GoOnWhereTheClockIsSetOrStands) {
  for (const bool flexible : {false, true}) {
    const double told_step_Nm = worst_ride(Telling::kAll, false, flexible).largest_step_Nm;
    for (const Telling telling : {Telling::kClockSet, Telling::kClockStands}) {
      const SentRide worst = worst_ride(telling, false, flexible);
      EXPECT_LT(worst.largest_error_rad, 5e-3) << flexible;
      EXPECT_LT(worst.largest_step_Nm, told_step_Nm + 1.0) << flexible;
    }
  }
}

TEST(JointLoopSentStreams, KeepTheJerkLimitWhateverIsTold) {
  constexpr double kJerk_rad_s3 = 2000.0;
  for (const Telling telling : {Telling::kAll, Telling::kNone, kMixed[0], kMixed[1], kMixed[2],
                                Telling::kClockSet, Telling::kClockStands})
    for (const bool timer_late : {false, true}) {
      const SentRide worst = worst_ride(telling, timer_late, false, kJerk_rad_s3);
      EXPECT_LT(worst.largest_jerk_rad_s3, 1.001 * kJerk_rad_s3);
      EXPECT_LT(worst.largest_step_Nm, 1.5);
    }
}

}  // namespace
}  // namespace strainwave::testing
