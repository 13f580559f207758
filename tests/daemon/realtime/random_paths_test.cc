// SPDX-License-Identifier: BSD-3-Clause
// Paths drawn at random on one, two and six joints, cold and warm, with friction that is and is not the table's, some paused on the way:
// what must hold of all of them. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "daemon/realtime/path_follower.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr MotionLimits kMotion{4.0, 30.0, 30.0};  // config/demo.toml
constexpr MotionLimits kModerate{kMotion.velocity_rad_s / 3.0, kMotion.acceleration_rad_s2 / 2.0,
                                 kMotion.deceleration_rad_s2 / 2.0};
constexpr double kJerk_rad_s3 = 6000.0;
constexpr double kWeak_Nm = 12.0;
/// Limits are kept but for rounding.
constexpr double kKept = 1.0 + 1e-6;
/// Half a second after the end: what small motions at rest leave.
constexpr double kLeft_rad = 4e-4;
constexpr int kPaused = 400;  ///< periods
constexpr int kAfter = 500;

/// Joints of one kind, and what must hold of them with 0.8 to 1.2 times the table's friction.
struct Kind {
  const char* name = "";
  bool flexible = false;
  double torque_limit_Nm = 0.0;  ///< 0: the demo's
  double jerk_rad_s3 = 0.0;      ///< limit; 0: none
  double torque_Nm = 0.0;        ///< that a moderate path takes at most
  double setpoint_off_rad = 0.0;
  double off_rad = 0.0;  ///< joint or link, from the path
};

BenchJoint joint_of(const Kind& kind, double friction, double temperature_C, unsigned seed) {
  BenchJoint joint = kind.flexible ? flexible_joint() : demo_joint();
  scale_friction(joint, friction);
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  joint.drive.seed = seed;
  JointControllerConfig& controller = joint.loop.controller;
  controller.motion = kMotion;
  controller.jerk_limit_rad_s3 = kind.jerk_rad_s3;
  if (kind.torque_limit_Nm > 0.0) controller.torque_limit_Nm = kind.torque_limit_Nm;
  // What the daemon takes for too large a load where the configuration has none.
  joint.loop.limits.load = {};
  joint.loop.limits.load.usual.accelerating_Nm =
      kMotion.acceleration_rad_s2 * kReferenceInertia_kgm2 * (kind.flexible ? 2.0 : 1.0);
  return joint;
}

double between(std::mt19937& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A sum of sines that begins and ends at rest at 0, in `count` knots over a second.
KnotPath drawn(std::mt19937& random, std::size_t count) {
  std::array<std::array<double, 3>, 3> waves;  // size, turns, phase
  for (auto& wave : waves)
    wave = {between(random, 0.0, 0.4), between(random, 0.2, 3.0),
            between(random, 0.0, 2.0 * std::numbers::pi)};
  const auto place_rad = [&](double u) {
    double sum_rad = 0.0;
    for (const auto& [size, turns, phase] : waves)
      sum_rad += size * std::sin(2.0 * std::numbers::pi * turns * u + phase);
    return std::pow(std::sin(std::numbers::pi * u), 2) * sum_rad;
  };
  KnotPath path;
  path.count = count;
  for (std::size_t i = 0; i < count; ++i) {
    const double u = static_cast<double>(i) / static_cast<double>(count - 1);
    const bool end = i == 0 || i + 1 == count;
    const double rate_rad_s = (place_rad(u + 1e-6) - place_rad(u - 1e-6)) / 2e-6;
    path.knots[i] = {u, end ? 0.0 : place_rad(u), end ? 0.0 : rate_rad_s};
  }
  return path;
}

/// One for each joint, all in the shortest time in which moderate limits let them.
std::vector<KnotPath> drawn_paths(std::mt19937& random, std::size_t joints) {
  const auto count = static_cast<std::size_t>(std::exp(between(random, std::log(8.0), std::log(300.0))));
  std::vector<KnotPath> paths;
  for (std::size_t i = 0; i < joints; ++i) paths.push_back(drawn(random, count));
  const PathLimits limits{{-3.0, 3.0}, kModerate, 1e9, kReferenceInertia_kgm2, kPeriod_s};
  const auto too_fast = [&](const KnotPath& path) { return find_defect(path, limits).has_value(); };
  while (std::any_of(paths.begin(), paths.end(), too_fast))
    for (KnotPath& path : paths)
      for (std::size_t i = 0; i < count; ++i) {
        path.knots[i].time_s *= 1.05;
        path.knots[i].velocity_rad_s /= 1.05;
      }
  return paths;
}

/// Where the setpoint of the motor is to be on the path.
double setpoint_rad(const BenchJoint& joint, const PathPoint& point) {
  const auto& link = joint.loop.controller.link;
  if (!link) return point.position_rad;
  return point.position_rad +
         link->link_inertia_kgm2 * point.acceleration_rad_s2 / link->spring.stiffness_1_Nm_rad;
}

/// `joints` on one path, paused for a while from `pause_at` on, a period; 0: never.
class Ride {
 public:
  Ride(const Kind& kind, const std::vector<BenchJoint>& joints, const std::vector<KnotPath>& paths)
      : kind_(kind),
        joints_(joints),
        paths_(paths),
        bench_(joints),
        readers_(paths.size()),
        last_(paths.size()) {
    for (std::size_t i = 0; i < joints.size(); ++i) {
      bench_.bring_to_hold(i, kind.flexible ? flexible_table() : demo_table());
      const auto slot = bench_.joint(i).path_slots().hand_over({7, static_cast<int>(paths.size()), paths[i]});
      EXPECT_EQ(bench_.order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
                Reason::kAccepted);
    }
  }

  void go(int pause_at) {
    EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
    const int end =
        static_cast<int>(1e3 * paths_[0].duration_s()) + (pause_at > 0 ? kPaused : 0) + 2 * kAfter;
    for (int k = 1; k < end; ++k) {
      if (pause_at > 0 && k == pause_at)
        bench_.order(paths_.size() - 1, OrderKind::kPausePath);
      else if (pause_at > 0 && k == pause_at + kPaused)
        bench_.order(0, OrderKind::kResumePath);
      else
        bench_.step();
      const double time_s = bench_.state(0).path_time_s;
      if (time_s == path_time_s_ && time_s > 0.0) ++rested_;
      goes_on_ = time_s > path_time_s_;
      path_time_s_ = time_s;
      for (std::size_t i = 0; i < paths_.size(); ++i) look(i, pause_at > 0);
    }
    EXPECT_GE(rested_, pause_at > 0 ? kPaused / 2 : 0);
    if (pause_at == 0) {
      EXPECT_EQ(rested_, 0);
    }
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      EXPECT_EQ(bench_.mode(i), Mode::kHolding);
      EXPECT_NEAR(link_rad(i), paths_[i].last().position_rad, kLeft_rad);
    }
  }

 private:
  double link_rad(std::size_t i) { return bench_.drive(i).simulated().plant().link_state().position_rad; }
  void look(std::size_t i, bool paused) {
    const state_v1& state = bench_.state(i);
    EXPECT_EQ(bench_.fault(i), Fault::kNone);
    for (const Notice notice : {Notice::kLoadHigh, Notice::kYielded, Notice::kOffStream})
      EXPECT_FALSE(bench_.has_notice(i, notice)) << static_cast<int>(notice);
    EXPECT_LE(std::abs(bench_.drive(i).command().torque_Nm), kind_.torque_Nm);
    EXPECT_EQ(std::isnan(state.path_time_s), std::isnan(path_time_s_)) << "all begin and end in one cycle";
    const double rad_s2 = (state.setpoint_velocity_rad_s - last_[i].rad_s) / kPeriod_s;
    if (goes_on_) {
      EXPECT_EQ(state.path_time_s, path_time_s_) << "one time for all";
      const PathPoint point = readers_[i].at(paths_[i], path_time_s_);
      EXPECT_NEAR(state.setpoint_position_rad, setpoint_rad(joints_[i], point), kind_.setpoint_off_rad);
      EXPECT_NEAR(link_rad(i), point.position_rad, kind_.off_rad);
      // A link on a spring gives its motor more to do than the path.
      const double share = paused ? 1.0 : 0.5;
      if (!kind_.flexible) {
        EXPECT_LE(std::abs(rad_s2), share * kMotion.acceleration_rad_s2 * kKept);
      }
      if (kind_.jerk_rad_s3 > 0.0) {
        EXPECT_LE(std::abs(rad_s2 - last_[i].rad_s2), kind_.jerk_rad_s3 * kPeriod_s * kKept);
      }
    }
    last_[i] = {state.setpoint_velocity_rad_s, rad_s2};
  }

  struct Last {
    double rad_s = 0.0;
    double rad_s2 = 0.0;
  };
  const Kind& kind_;
  const std::vector<BenchJoint>& joints_;
  const std::vector<KnotPath>& paths_;
  JointBench bench_;
  std::vector<PathReader> readers_;
  std::vector<Last> last_;
  double path_time_s_ = 0.0;
  bool goes_on_ = false;
  int rested_ = 0;  ///< periods on the path in which its time rests
};

class RandomPaths : public ::testing::TestWithParam<Kind> {};

TEST_P(RandomPaths, AreFollowedTogetherWithinTheirLimits) {
  unsigned seed = 0;
  for (const double friction : {0.8, 1.0, 1.2})
    for (const double temperature_C : {-8.0, 5.0, 25.0, 38.0})
      for (const std::size_t count : {1U, 2U, 6U}) {
        const ::testing::ScopedTrace trace(__FILE__, __LINE__,
                                           "seed " + std::to_string(++seed) + ", friction " +
                                               std::to_string(friction) + ", degC " +
                                               std::to_string(temperature_C));
        std::mt19937 random(seed);
        const std::vector<KnotPath> paths = drawn_paths(random, count);
        std::vector<BenchJoint> joints;
        for (unsigned i = 0; i < count; ++i)
          joints.push_back(joint_of(GetParam(), friction, temperature_C, seed + i));
        Ride(GetParam(), joints, paths).go(seed % 3 == 0 ? static_cast<int>(500 * paths[0].duration_s()) : 0);
      }
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, RandomPaths,
                         ::testing::Values(Kind{"Rigid", false, 0.0, 0.0, 23.0, 1e-6, 0.85e-3},
                                           Kind{"Weak", false, kWeak_Nm, 0.0, kWeak_Nm, 1e-6, 0.85e-3},
                                           Kind{"JerkLimited", false, 0.0, kJerk_rad_s3, 23.0, 0.2e-3,
                                                1.4e-3},
                                           Kind{"Flexible", true, 0.0, 0.0, 12.0, 0.2e-3, 1.6e-3}),
                         [](const ::testing::TestParamInfo<Kind>& instance) { return instance.param.name; });

}  // namespace
}  // namespace strainwave::testing
