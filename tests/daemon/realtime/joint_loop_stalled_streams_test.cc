// Streams whose loop is away: their time goes on meanwhile. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "control/state_estimator.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr OverrunLimits kTolerant{1000, 2.0, 1.0};
constexpr double kStalledOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kStalledAmplitude_rad = 0.5;
/// The sine's own speed is 1.57; who was away for 120 ms is some 0.2 rad behind, and the joint could go at 6.
constexpr double kFastestBack_rad_s = 3.5;

/// What streams say of when a sample is for.
enum class Stamp { kCycle, kSent, kNone };

struct StalledStream {
  Stamp stamp = Stamp::kCycle;
  int derivatives = 1;
  int every = 10;    ///< periods
  int ahead = 20;    ///< periods, of the stamps
  int periods = 40;  ///< of the stall
  double after_s = 1.2;
};
std::ostream& operator<<(std::ostream& out, const StalledStream& s) {
  return out << static_cast<int>(s.stamp) << ", derivatives " << s.derivatives << ", every " << s.every
             << ", stall of " << s.periods << " after " << s.after_s << " s";
}

double sine_rad(double t) {
  return kStalledAmplitude_rad * (1.0 - std::cos(kStalledOmega_rad_s * t));
}
double sine_rad_s(double t) {
  return kStalledAmplitude_rad * kStalledOmega_rad_s * std::sin(kStalledOmega_rad_s * t);
}

struct StalledErrors {
  double usual_rad = 0.0;       ///< before the stall
  double at_its_end_rad = 0.0;  ///< in the first period after it: what it costs by itself
  double back_rad = 0.0;        ///< from then on at most
  double afterwards_rad = 0.0;  ///< from 50 ms after it on, and where it was longer, from as long after it
  double fastest_rad_s = 0.0;   ///< the setpoint's, after it
  double setpoint_rad =
      0.0;  ///< the setpoint's way from the stream, from half a second before the stall on at most
};

/// Who streams goes on over the stall; what was sent meanwhile waits for the loop.
StalledErrors follow(const BenchJoint& joint, const GainTable& table, const StalledStream& stream) {
  JointBench bench({joint}, kTolerant);
  bench.bring_to_hold(0, table);
  const std::int64_t began = bench.cycle();
  const auto stall_at = static_cast<std::int64_t>(std::llround(stream.after_s * 1e3));
  StalledErrors errors;
  std::int64_t sent = -1;
  while (bench.cycle() - began < stall_at + 1500) {
    const std::int64_t now = bench.cycle() - began;
    const bool stalls = now == stall_at;
    if (stalls) bench.stall(stream.periods);
    // Of the cycle that comes next.
    const std::int64_t next = now + 1 + (stalls ? stream.periods : 0);
    for (std::int64_t k = now + 1; k <= next; ++k) {
      if (k % stream.every != 0) continue;
      const std::int64_t for_cycle = k + (stream.stamp == Stamp::kCycle ? stream.ahead : 0);
      const double t = 1e-3 * static_cast<double>(for_cycle);
      Order order{.kind = OrderKind::kSetpoint,
                  .position_rad = sine_rad(t),
                  .valid_for_s = 0.5,
                  .stream_id = 1,
                  .begins_stream = sent < 0};
      order.velocity_rad_s = sine_rad_s(t);
      order.derivatives = stream.derivatives;
      if (stream.stamp == Stamp::kCycle) order.at_cycle = began + for_cycle;
      if (stream.stamp == Stamp::kSent) order.sent_us = 1'700'000'000'000'000 + 1000 * k;
      EXPECT_TRUE(bench.joint(0).orders().push(order));
      sent = k;
    }
    bench.step();
    const std::int64_t here = bench.cycle() - began;
    const double off_rad =
        std::abs(bench.state(0).joint_position_rad - sine_rad(1e-3 * static_cast<double>(here)));
    if (here > 600 && here <= stall_at) errors.usual_rad = std::max(errors.usual_rad, off_rad);
    if (here > 600)
      errors.setpoint_rad = std::max(
          errors.setpoint_rad,
          std::abs(bench.state(0).setpoint_position_rad - sine_rad(1e-3 * static_cast<double>(here + 1))));
    const std::int64_t since = here - stall_at - stream.periods;
    if (since == 1) errors.at_its_end_rad = off_rad;
    if (since >= 1) errors.back_rad = std::max(errors.back_rad, off_rad);
    if (since > std::max(50, stream.periods))
      errors.afterwards_rad = std::max(errors.afterwards_rad, off_rad);
    if (here > stall_at)
      errors.fastest_rad_s = std::max(errors.fastest_rad_s, std::abs(bench.state(0).setpoint_velocity_rad_s));
  }
  EXPECT_EQ(bench.fault(0), Fault::kNone) << stream;
  return errors;
}

/// What comes of speed and place after a stall, which nobody knows exactly.
constexpr double kMore_rad = 2.5e-3;
/// What friction that turns round makes of a turn, and more where the stall has made the observer forget it.
constexpr double kOnStream_rad = 1.3e-3;

// Its time stood over the stall: for a tenth of a second the joint was up to 65 mrad off after 40 ms.
TEST(StalledStream, ThatIsStampedIsOnItsTimesAfterwards) {
  double farthest_rad = 0.0;
  double cost_rad = 0.0;
  for (const int derivatives : {0, 1})
    for (const int every : {2, 10, 20})
      for (const int periods : {25, 40, 120})
        for (const double after_s : {0.8, 1.0, 1.25}) {
          const StalledStream stream{Stamp::kCycle, derivatives, every, every + 20, periods, after_s};
          const StalledErrors errors = follow(demo_joint(), demo_table(), stream);
          EXPECT_LT(errors.usual_rad, kOnStream_rad) << stream;
          EXPECT_LT(errors.afterwards_rad, kOnStream_rad) << stream;
          EXPECT_LT(errors.fastest_rad_s, kFastestBack_rad_s) << stream;
          farthest_rad = std::max(farthest_rad, errors.afterwards_rad);
          // Of what is longer than the stamps are ahead nobody knew.
          if (periods > 40) continue;
          EXPECT_LT(errors.back_rad, errors.at_its_end_rad + kMore_rad) << stream;
          cost_rad = std::max(cost_rad, errors.back_rad);
        }
  std::printf("after a stall of up to 40 ms at most %.2e rad off a stamped stream, 50 ms later %.2e\n",
              cost_rad, farthest_rad);
}

TEST(StalledStream, OfAJointOnASpringIsOnItsTimesAfterwards) {
  for (const bool told : {true, false})
    for (const int periods : {25, 40}) {
      const StalledStream stream{Stamp::kCycle, 1, 10, 30, periods, 1.2};
      const StalledErrors errors = follow(flexible_joint(told), flexible_table(), stream);
      std::printf("on a spring, told %d: %.2e rad off before the stall, %.2e afterwards\n", told,
                  errors.usual_rad, errors.afterwards_rad);
      EXPECT_LT(errors.afterwards_rad, errors.usual_rad + kOnStream_rad) << stream;
    }
}

// A joint that stands on a stream that stands has nothing to go on with: its stream goes on all the same.
TEST(StalledStream, ThatBeginsToMoveInTheStallIsOnItsTimesAfterwards) {
  for (const double after_s : {0.01, 1.99, 2.0}) {
    const StalledStream stream{Stamp::kCycle, 1, 10, 30, 40, after_s};
    EXPECT_LT(follow(demo_joint(), demo_table(), stream).afterwards_rad, kOnStream_rad) << stream;
  }
}

// What came meanwhile was taken to be for as many periods earlier as were left out: the setpoint was up to 27 mrad off. Where nobody knows what
// the joint did it goes on from where it is.
TEST(StalledStream, ThatIsStampedHasItsSetpointOnItsTimesOverEveryNumberOfPeriodsLeftOut) {
  constexpr double kSamples_rad = 2e-5;  // what lies between samples without velocity is not told
  double from_here_rad = 0.0;
  for (const int derivatives : {0, 1})
    for (const int every : {2, 10, 20})
      for (int periods = 1; periods < kMaxElapsedPeriods + 5; ++periods)
        for (const double after_s : {0.8, 1.0, 1.25}) {
          const StalledStream stream{Stamp::kCycle, derivatives, every, every + 20, periods, after_s};
          const StalledErrors errors = follow(demo_joint(), demo_table(), stream);
          const bool known = periods < kMaxElapsedPeriods;
          EXPECT_LT(errors.setpoint_rad, known ? kSamples_rad : 3e-3) << stream;
          if (!known) from_here_rad = std::max(from_here_rad, errors.setpoint_rad);
        }
  std::printf("over a stall of 20 to 24 ms the setpoint is at most %.2e rad off a stamped stream\n",
              from_here_rad);
}

// What is not stamped comes late by the stall, and then at its times again. What came in short ones was taken to have come before them, and
// the stream was up to 32 mrad off for some tenths of a second.
TEST(StalledStream, ThatIsNotStampedIsAsLateAsItWas) {
  for (const Stamp stamp : {Stamp::kSent, Stamp::kNone})
    for (const int every : {2, 10, 20})
      for (const int periods : {4, 9, 14, 19, 25, 40}) {
        const StalledStream stream{stamp, 1, every, 0, periods, 1.2};
        EXPECT_LT(follow(demo_joint(), demo_table(), stream).afterwards_rad, kOnStream_rad) << stream;
      }
}

}  // namespace
}  // namespace strainwave::testing
