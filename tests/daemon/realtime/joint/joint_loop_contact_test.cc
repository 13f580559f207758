// SPDX-License-Identifier: BSD-3-Clause
// A joint that runs into a wall, rigid or with a link on a spring: how hard it pushes, how soon it yields, and that it stays away.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kWall_rad = 0.5;
constexpr double kSpeed_rad_s = 1.0;
constexpr double kLoad_Nm = 12.0;
constexpr double kNotice_Nm = 8.0;
constexpr int kOverloadPeriods = 20;

/// Times in periods since the first contact; -1: never.
struct Blow {
  double peak_torque_Nm = 0.0;
  int overloaded = -1;  ///< the wall pushes with more than the allowed load
  int noticed = -1;
  int yielded = -1;  ///< the torque is that of a yielding joint
  int touches = 0;
  double last_speed_rad_s = 0.0;  ///< largest speed in the last half second
};

BenchJoint joint_before_a_wall(double stiffness_Nm_rad, bool flexible, OverloadStop stop) {
  BenchJoint joint = demo_joint();
  JointControllerConfig& controller = joint.loop.controller;
  if (flexible) put_on_spring(joint, flexible_plant());
  const double moving_kgm2 =
      flexible ? controller.link->link_inertia_kgm2 : joint.drive.plant.joint.inertia_kgm2;
  joint.drive.plant.effects.contact = {kWall_rad, stiffness_Nm_rad,
                                       0.2 * std::sqrt(stiffness_Nm_rad * moving_kgm2)};
  joint.loop.limits.load.load_Nm = kLoad_Nm;
  joint.loop.limits.load.notice_Nm = kNotice_Nm;
  joint.loop.overload_s = kOverloadPeriods * 1e-3;
  joint.loop.overload_stop = stop;
  return joint;
}

class ContactWithAWall : public ::testing::TestWithParam<std::tuple<double, bool>> {
 protected:
  Blow run_into_it(OverloadStop stop) {
    const auto [stiffness_Nm_rad, flexible] = GetParam();
    const BenchJoint joint = joint_before_a_wall(stiffness_Nm_rad, flexible, stop);
    bench_.emplace(std::vector<BenchJoint>{joint});
    bench_->bring_to_hold(0, flexible ? flexible_table() : demo_table());
    EXPECT_EQ(bench_->order(0, Order{.kind = OrderKind::kSetpoint,
                                     .position_rad = 2.0 * kWall_rad,
                                     .speed_limit_rad_s = kSpeed_rad_s}),
              Reason::kAccepted);
    Blow blow;
    int touched = -1;
    for (int k = 0; k < 3000; ++k) {
      bench_->step();
      look(joint.drive.plant.effects.contact, touched < 0 ? 0 : k - touched, blow);
      if (touched < 0 && blow.touches > 0) touched = k;
      if (k >= 2500)
        blow.last_speed_rad_s =
            std::max(blow.last_speed_rad_s,
                     std::abs(bench_->drive(0).simulated().plant().link_state().velocity_rad_s));
    }
    return blow;
  }

  std::optional<JointBench> bench_;

 private:
  void look(const Contact& wall, int since, Blow& blow) {
    const JointState link = bench_->drive(0).simulated().plant().link_state();
    const double push_Nm = wall.torque_Nm(link.position_rad, link.velocity_rad_s);
    const double torque_Nm = bench_->state(0).torque_commanded_Nm;
    if (push_Nm > 0.0 && !touching_) ++blow.touches;
    touching_ = push_Nm > 0.0;
    if (blow.touches == 0) return;
    blow.peak_torque_Nm = std::max(blow.peak_torque_Nm, std::abs(torque_Nm));
    const auto first = [since](int& when, bool now) {
      if (when < 0 && now) when = since;
    };
    first(blow.overloaded, push_Nm > kLoad_Nm);
    first(blow.noticed, bench_->has_notice(0, Notice::kLoadHigh));
    // The torque of a joint that yields, rests or is off has no feedback.
    const bool yields = bench_->state(0).torque_feedback_Nm == 0.0;
    first(blow.yielded, blow.overloaded >= 0 && yields);
  }

  bool touching_ = false;
};

/// The load estimate lags the wall's push by this time.
constexpr int kShowsPeriods = 30;

TEST_P(ContactWithAWall, SwitchesOffInTime) {
  const Blow blow = run_into_it(OverloadStop::kTorqueOff);
  EXPECT_EQ(bench_->fault(0), Fault::kOverload);
  ASSERT_GE(blow.overloaded, 0);
  EXPECT_LE(blow.yielded, blow.overloaded + kOverloadPeriods + kShowsPeriods);
  EXPECT_LE(blow.noticed, blow.yielded);
  EXPECT_EQ(blow.touches, 1) << "it does not bounce";
}

TEST_P(ContactWithAWall, YieldsAndHoldsBeforeIt) {
  const Blow blow = run_into_it(OverloadStop::kHoldLoad);
  EXPECT_EQ(bench_->fault(0), Fault::kNone);
  EXPECT_EQ(bench_->mode(0), Mode::kHolding);
  ASSERT_GE(blow.overloaded, 0);
  EXPECT_LE(blow.yielded, blow.overloaded + kOverloadPeriods + kShowsPeriods);
  EXPECT_EQ(blow.touches, 1) << "it does not bounce";
  EXPECT_LT(bench_->drive(0).simulated().plant().link_state().position_rad, kWall_rad);
  EXPECT_LT(blow.last_speed_rad_s, 0.05);
  EXPECT_LE(blow.peak_torque_Nm, kReferencePeakTorque_Nm);
}

INSTANTIATE_TEST_SUITE_P(OfEveryStiffness, ContactWithAWall,
                         ::testing::Combine(::testing::Values(200.0, 2000.0, 20000.0), ::testing::Bool()),
                         [](const ::testing::TestParamInfo<std::tuple<double, bool>>& instance) {
                           return std::to_string(static_cast<int>(std::get<double>(instance.param))) +
                                  (std::get<bool>(instance.param) ? "OnASpring" : "");
                         });

// Its following_error_rad of a tenth of a radian takes 17 ms at this speed.
TEST(Contact, AFastJointIsTooFarFromItsOrdersBeforeItsLoadHasLasted) {
  for (const OverloadStop stop : {OverloadStop::kTorqueOff, OverloadStop::kHoldLoad}) {
    JointBench bench({joint_before_a_wall(20000.0, false, stop)});
    bench.bring_to_hold(0);
    ASSERT_EQ(bench.order(0, Order{.kind = OrderKind::kSetpoint,
                                   .position_rad = 2.0 * kWall_rad,
                                   .speed_limit_rad_s = 6.0 * kSpeed_rad_s}),
              Reason::kAccepted);
    bench.run(1.0);
    EXPECT_EQ(bench.fault(0), Fault::kFollowingError);
  }
}

// A constant load moves the joint only while it yields. Once the joint holds again, the load pushes it again at once.
TEST(Contact, ALoadThatIsBackAsSoonAsTheJointIsHeldIsAFaultOfTheLoad) {
  for (const bool flexible : {false, true})
    for (const double load_Nm : {14.0, 20.0, 28.0, 34.0}) {
      BenchJoint joint = joint_before_a_wall(2000.0, flexible, OverloadStop::kHoldLoad);
      joint.drive.plant.effects.contact = {};
      JointBench bench({joint});
      bench.bring_to_hold(0, flexible ? flexible_table() : demo_table());
      // The load rises within 0.2 s, as when a person leans on the joint.
      for (int k = 0; k < 1500 && bench.fault(0) == Fault::kNone; ++k) {
        bench.drive(0).simulated().set_load_torque_Nm(-load_Nm * std::min(1.0, k / 200.0));
        bench.step();
      }
      EXPECT_EQ(bench.fault(0), Fault::kOverload) << load_Nm << " N.m, " << (flexible ? "spring" : "rigid");
    }
}

}  // namespace
}  // namespace strainwave::testing
