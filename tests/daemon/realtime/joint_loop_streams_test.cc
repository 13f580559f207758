// A sine of 0.5 rad and 0.5 Hz streamed to the whole loop on the simulated joint, at every rate and with what a network does to it: what
// torque it makes, and where the joint is. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kAmplitude_rad = 0.5;
// Where the joint turns round, friction changes its sign: the sine itself takes 7 N.m in a period there, and what the
// observer makes of it differs from ride to ride by more than streams do.
constexpr double kTurning_rad_s = 0.3;
constexpr int kBegin = 2000;  // periods until the motion is judged
constexpr int kEnd = 6000;

struct Ride {
  double rms_torque_Nm = 0.0;
  double largest_step_Nm = 0.0;  ///< in a period, while the joint does not turn round
  double rms_error_rad = 0.0;    ///< from the sine, the allowed lag ago
  double largest_error_rad = 0.0;
  bool off_stream = false;
};

struct Stream {
  int every = 10;  ///< periods
  int derivatives = 0;
  double lost = 0.0;   ///< share
  bool timed = false;  ///< sent 30 periods ahead
};

Order sample(const Stream& stream, std::int64_t cycle, std::int64_t period) {
  const std::int64_t ahead = stream.timed ? 30 : 0;
  const double phase = kOmega_rad_s * 1e-3 * static_cast<double>(period + ahead);
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.stream_id = 1;
  order.begins_stream = period == 0;
  order.valid_for_s = 0.2;
  order.position_rad = kAmplitude_rad * std::sin(phase);
  order.derivatives = stream.derivatives;
  if (stream.derivatives > 0) order.velocity_rad_s = kAmplitude_rad * kOmega_rad_s * std::cos(phase);
  if (stream.derivatives > 1)
    order.acceleration_rad_s2 = -kAmplitude_rad * kOmega_rad_s * kOmega_rad_s * std::sin(phase);
  if (stream.timed) order.at_cycle = cycle + ahead;
  return order;
}

Ride ride(const Stream& stream) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  std::mt19937 random(11);
  Ride result;
  double last_Nm = 0.0;
  for (int k = 0; k < kEnd; ++k) {
    const bool sent =
        k % stream.every == 0 && (k == 0 || std::generate_canonical<double, 32>(random) >= stream.lost);
    // The order is obeyed in the cycle after the bench's present one.
    if (!sent) bench.step();
    if (sent) {
      EXPECT_EQ(bench.order(0, sample(stream, bench.cycle() + 1, k)), Reason::kAccepted) << k;
    }
    const double torque_Nm = bench.state(0).torque_commanded_Nm;
    if (k >= kBegin) {
      // What was commanded a period ago, the joint shows now; positions alone lag one sample.
      const double lag = 1.0 + (stream.derivatives == 0 && !stream.timed ? stream.every : 0);
      const double error_rad =
          bench.state(0).joint_position_rad - kAmplitude_rad * std::sin(kOmega_rad_s * 1e-3 * (k - lag));
      result.rms_torque_Nm += torque_Nm * torque_Nm;
      result.rms_error_rad += error_rad * error_rad;
      result.largest_error_rad = std::max(result.largest_error_rad, std::abs(error_rad));
      if (std::abs(bench.state(0).setpoint_velocity_rad_s) > kTurning_rad_s)
        result.largest_step_Nm = std::max(result.largest_step_Nm, std::abs(torque_Nm - last_Nm));
      result.off_stream = result.off_stream || bench.has_notice(0, Notice::kOffStream);
    }
    last_Nm = torque_Nm;
  }
  result.rms_torque_Nm = std::sqrt(result.rms_torque_Nm / (kEnd - kBegin));
  result.rms_error_rad = std::sqrt(result.rms_error_rad / (kEnd - kBegin));
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  EXPECT_FALSE(bench.has_notice(0, Notice::kPlainLaw));
  return result;
}

/// The sine itself: a setpoint for each period, all derivatives, each for its own cycle.
const Ride& smooth_sine() {
  static const Ride smooth = ride({1, 2, 0.0, true});
  return smooth;
}

class JointLoopStreams : public ::testing::TestWithParam<Stream> {};

TEST_P(JointLoopStreams, TakeTheTorqueOfTheMotionAndNoMore) {
  const Ride streamed = ride(GetParam());
  EXPECT_LT(streamed.rms_torque_Nm, 1.2 * smooth_sine().rms_torque_Nm);
  EXPECT_LT(streamed.largest_step_Nm, smooth_sine().largest_step_Nm + 1.0);
  EXPECT_LT(streamed.rms_error_rad, 1e-3);
  EXPECT_FALSE(streamed.off_stream);
}

INSTANTIATE_TEST_SUITE_P(AtEveryRate, JointLoopStreams,
                         ::testing::Values(Stream{50, 0}, Stream{50, 1}, Stream{50, 2}, Stream{20, 0},
                                           Stream{20, 1}, Stream{10, 0}, Stream{10, 1}, Stream{10, 2},
                                           Stream{5, 0}, Stream{5, 1}, Stream{3, 0}, Stream{3, 1},
                                           Stream{2, 0}, Stream{2, 1}, Stream{10, 1, 0.0, true},
                                           Stream{20, 0, 0.0, true}),
                         [](const ::testing::TestParamInfo<Stream>& stream) {
                           return std::to_string(1000 / stream.param.every) + "Hz" +
                                  std::to_string(stream.param.derivatives) +
                                  (stream.param.timed ? "Timed" : "");
                         });

TEST(JointLoopStreaming, BridgeATenthOfTheirSamplesLost) {
  for (const int derivatives : {0, 1, 2}) {
    const Ride streamed = ride({10, derivatives, 0.1});
    EXPECT_LT(streamed.largest_error_rad, 5e-3) << derivatives;
    EXPECT_LT(streamed.rms_torque_Nm, 1.5 * smooth_sine().rms_torque_Nm) << derivatives;
  }
}

TEST(JointLoopStreaming, ShowTheirLastSampleAsTheTarget) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
    Order order;
    order.kind = OrderKind::kSetpoint;
    order.stream_id = 1;
    order.begins_stream = target_rad == 0.001;
    order.valid_for_s = 1.0;
    order.position_rad = target_rad;
    ASSERT_EQ(bench.order(0, order), Reason::kAccepted);
    for (int k = 0; k < 300; ++k) {
      ASSERT_EQ(bench.state(0).target_position_rad, target_rad) << k;
      bench.step();
    }
  }
}

TEST(JointLoopStreaming, RefuseASampleForACycleThatIsOverOrFarAway) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  Order order = sample({10, 1, 0.0, true}, bench.cycle() + 1, 0);
  ASSERT_EQ(bench.order(0, order), Reason::kAccepted);
  order.begins_stream = false;
  order.at_cycle = bench.cycle();
  EXPECT_EQ(bench.order(0, order), Reason::kTooOld);
  EXPECT_EQ(bench.last_reply().value, static_cast<double>(order.at_cycle));
  EXPECT_GE(bench.last_reply().limit, bench.last_reply().value);
  order.at_cycle = bench.cycle() + 2000;
  EXPECT_EQ(bench.order(0, order), Reason::kOutOfRange);
  EXPECT_NEAR(bench.last_reply().value, 2.0, 0.002);
  EXPECT_EQ(bench.last_reply().limit, 1.0);
}

TEST(JointLoopStreaming, AreForgottenByTheNextEnable) {
  const auto shows_expiry = [](JointBench& bench) {
    return (bench.state(0).notices & static_cast<std::int32_t>(Notice::kSetpointExpired)) != 0;
  };
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.move(0, 0.1, 0.01), Reason::kAccepted);
  for (int i = 0; i < 500; ++i) bench.step();
  ASSERT_TRUE(shows_expiry(bench));
  ASSERT_EQ(bench.order(0, OrderKind::kDisable), Reason::kAccepted);
  for (int i = 0; i < 200; ++i) bench.step();
  ASSERT_EQ(bench.order(0, OrderKind::kEnable), Reason::kAccepted);
  for (int i = 0; i < 200; ++i) bench.step();
  EXPECT_FALSE(shows_expiry(bench));
  EXPECT_EQ(bench.move(0, 0.2, 0.01, false), Reason::kStreamEnded);
}

TEST(JointLoopStreaming, SayThatTheyAskForMoreThanTheJointHas) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.stream_id = 1;
  order.begins_stream = true;
  order.valid_for_s = 0.2;
  order.derivatives = 1;
  bool told = false;
  for (int i = 0; i < 50 && bench.fault(0) == Fault::kNone; ++i) {
    order.position_rad = i % 10 < 5 ? 0.01 * i : 0.4 - 0.01 * i;
    order.velocity_rad_s = i % 10 < 5 ? 10.0 : -10.0;
    EXPECT_EQ(bench.order(0, order), Reason::kAccepted);
    order.begins_stream = false;
    bench.run(0.009);
    told = told || bench.has_notice(0, Notice::kOffStream);
    EXPECT_LE(std::abs(bench.state(0).setpoint_velocity_rad_s),
              demo_joint().loop.controller.motion.velocity_rad_s);
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
}

}  // namespace
}  // namespace strainwave::testing
