// Joints whose torque limit is near their friction, where they land. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kJerkLimit_rad_s3 = 1000.0;

struct Ride {
  double largest_jerk_rad_s3 = 0.0;  ///< of the setpoint
  int rests_after_ms = 0;            ///< the setpoint
  double off_rad = 0.0;              ///< at the end
};

Ride move(double torque_limit_Nm, double friction, double temperature_C, double to_rad) {
  BenchJoint joint = demo_joint_with_friction(friction);
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  joint.loop.controller.torque_limit_Nm = torque_limit_Nm;
  joint.loop.controller.jerk_limit_rad_s3 = kJerkLimit_rad_s3;
  JointBench bench({joint});
  bench.bring_to_hold(0);
  EXPECT_EQ(bench.move(0, to_rad), Reason::kAccepted);
  const double begin_rad = bench.state(0).setpoint_position_rad;
  double last_rad[3] = {begin_rad, begin_rad, begin_rad};
  Ride ride;
  int arrives = 0, rests = 0;
  double last_Nm = 0.0;
  for (int k = 1; k < 4000; ++k) {
    bench.step();
    const state_v1& state = bench.state(0);
    const double setpoint_rad = state.setpoint_position_rad;
    const double change_rad = setpoint_rad - 3.0 * last_rad[0] + 3.0 * last_rad[1] - last_rad[2];
    ride.largest_jerk_rad_s3 =
        std::max(ride.largest_jerk_rad_s3, std::abs(change_rad) / (kPeriod_s * kPeriod_s * kPeriod_s));
    last_rad[2] = std::exchange(last_rad[1], std::exchange(last_rad[0], setpoint_rad));
    if (setpoint_rad != to_rad) arrives = k;
    if (state.torque_commanded_Nm != last_Nm) rests = k;
    last_Nm = state.torque_commanded_Nm;
  }
  ride.rests_after_ms = rests - arrives;
  ride.off_rad = std::abs(bench.state(0).joint_position_rad - to_rad);
  return ride;
}

// A push of one period reached half a count, so that every count at the target asked for a new plan, which begins where the joint is: the
// setpoint jumped by 40 to 900 microradians.
TEST(WeakJoint, LandsWithoutAJumpOfItsSetpoint) {
  const double count_rad = demo_joint().loop.controller.encoder_resolution_rad;
  for (const double torque_limit_Nm : {5.0, 6.0, 8.0, 12.0})
    for (const double friction : {0.8, 1.0})
      for (const double temperature_C : {-5.0, 10.0, 25.0, 40.0})
        for (const double to_rad : {0.02, 0.1, 0.3, 0.5}) {
          const Ride ride = move(torque_limit_Nm, friction, temperature_C, to_rad);
          const auto which = ::testing::Message() << torque_limit_Nm << " N m, friction " << friction << ", "
                                                  << temperature_C << " degC, to " << to_rad;
          EXPECT_LT(ride.largest_jerk_rad_s3, 1.001 * kJerkLimit_rad_s3) << which;
          EXPECT_LT(ride.rests_after_ms, 150) << which;
          EXPECT_LT(ride.off_rad, count_rad) << which;
        }
}

}  // namespace
}  // namespace strainwave::testing
