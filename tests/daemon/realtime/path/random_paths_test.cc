// SPDX-License-Identifier: BSD-3-Clause
// Random paths on one, two and six joints, cold and warm, with friction equal to the table's or not, some
// paused on the way. The limits must hold, and the joints must stay near their paths. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr MotionLimits kMotion{4.0, 30.0, 30.0};  // config/demo.toml
constexpr double kJerk_rad_s3 = 6000.0;
constexpr double kLongest_s = 4.0;
/// Resolution of points that a person teaches by hand.
constexpr double kTaught_rad = 1e-4;
/// Probability that one of several joints does not move.
constexpr double kStays = 0.15;
/// The limits hold up to rounding.
constexpr double kKept = 1.0 + 1e-6;
/// Largest allowed distance of a joint from its path, at moderate speed.
constexpr double kFarOff_rad = 0.5e-3;
/// Half a second after the end of the path. A larger distance would cause a notice (rest_tolerance_rad).
constexpr double kLeft_rad = 1e-3;
constexpr double kPause_s = 0.4;

enum class Kind { kRigid, kJerkLimited, kSpring };

double between(std::mt19937_64& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// Velocities for which the acceleration has no step at inner knots: the spline that is at rest at both ends.
///   v_i-1 / h_i-1 + 2 v_i (1 / h_i-1 + 1 / h_i) + v_i+1 / h_i = 3 (d_i-1 / h_i-1 + d_i / h_i)
void give_spline_velocities(KnotPath& path) {
  std::array<double, KnotPath::kMostKnots> above{}, right{};
  for (std::size_t i = 1; i + 1 < path.count; ++i) {
    const double before_s = path.knots[i].time_s - path.knots[i - 1].time_s;
    const double after_s = path.knots[i + 1].time_s - path.knots[i].time_s;
    const double before_rad_s = (path.knots[i].position_rad - path.knots[i - 1].position_rad) / before_s;
    const double after_rad_s = (path.knots[i + 1].position_rad - path.knots[i].position_rad) / after_s;
    const double pivot = 2.0 * (1.0 / before_s + 1.0 / after_s) - above[i - 1] / before_s;
    above[i] = 1.0 / after_s / pivot;
    right[i] = (3.0 * (before_rad_s / before_s + after_rad_s / after_s) - right[i - 1] / before_s) / pivot;
  }
  path.knots[path.count - 1].velocity_rad_s = path.knots[0].velocity_rad_s = 0.0;
  for (std::size_t i = path.count - 1; i-- > 1;)
    path.knots[i].velocity_rad_s = right[i] - above[i] * path.knots[i + 1].velocity_rad_s;
}

/// A spline through a few points, or one through many points of waves, rounded to 0.1 mrad.
KnotPath draw_part(std::mt19937_64& random, const std::vector<double>& times_s, double reach_rad) {
  const bool taught = times_s.size() > 16;
  KnotPath path;
  const double turns = between(random, 0.2, 3.0);
  const double phase = between(random, 0.0, 2.0 * std::numbers::pi);
  for (const double time_s : times_s) {
    PathKnot& knot = path.knots[path.count++] = {time_s, 0.0, 0.0};
    const double u = time_s / times_s.back();
    const double in = std::min(1.0, 8.0 * u);
    const double wave_rad =
        reach_rad * in * in * (3.0 - 2.0 * in) * std::sin(2.0 * std::numbers::pi * turns * u + phase);
    const bool stays = path.count == 1 || between(random, 0.0, 1.0) < kStays;
    if (taught)
      knot.position_rad = kTaught_rad * std::round(wave_rad / kTaught_rad);
    else if (!stays)
      knot.position_rad = between(random, -reach_rad, reach_rad);
    else if (path.count > 1)
      knot.position_rad = path.knots[path.count - 2].position_rad;
  }
  give_spline_velocities(path);
  return path;
}

void stretch(KnotPath& path, double in_time, double in_size) {
  for (std::size_t i = 0; i < path.count; ++i) {
    path.knots[i].time_s *= in_time;
    path.knots[i].position_rad *= in_size;
    path.knots[i].velocity_rad_s *= in_size / in_time;
  }
}

/// A part for each joint, with the same times, within a third of the joints' speed and half of their acceleration.
std::vector<KnotPath> draw_path(std::mt19937_64& random, std::size_t joints) {
  std::vector<double> times_s(std::uniform_int_distribution<std::size_t>(0, 1)(random) == 0
                                  ? std::uniform_int_distribution<std::size_t>(3, 16)(random)
                                  : std::uniform_int_distribution<std::size_t>(17, 300)(random));
  for (std::size_t i = 1; i < times_s.size(); ++i) times_s[i] = times_s[i - 1] + between(random, 0.6, 1.4);
  const double reach_rad = std::exp(between(random, std::log(0.02), std::log(1.2)));
  std::vector<KnotPath> parts;
  double speed_rad_s = 1e-9, acceleration_rad_s2 = 1e-9;
  for (std::size_t joint = 0; joint < joints; ++joint) {
    const KnotPath& part = parts.emplace_back(draw_part(random, times_s, reach_rad));
    PathReader reader;
    for (double t = 0.0; t < part.duration_s(); t += part.duration_s() / 10000.0) {
      const Reference point = reader.at(part, t);
      speed_rad_s = std::max(speed_rad_s, std::abs(point.velocity_rad_s));
      acceleration_rad_s2 = std::max(acceleration_rad_s2, std::abs(point.acceleration_rad_s2));
    }
  }
  const double least_s = 4e-3 * static_cast<double>(times_s.size());
  const double in_time = std::max(
      {speed_rad_s / (kMotion.velocity_rad_s / 3.0 * between(random, 0.2, 1.0)),
       std::sqrt(acceleration_rad_s2 / (0.49 * kMotion.acceleration_rad_s2 * between(random, 0.2, 1.0))),
       least_s / times_s.back()});
  // A path that would take too long is made shorter, at the same speed.
  const double less = std::min(1.0, kLongest_s / (in_time * times_s.back()));
  for (KnotPath& part : parts) {
    stretch(part, in_time, 1.0);
    stretch(part, less, less * less);
  }
  return parts;
}

BenchJoint joint_of(Kind kind, double friction, double temperature_C, std::uint64_t seed) {
  BenchJoint joint = kind == Kind::kSpring ? flexible_joint() : demo_joint();
  scale_friction(joint, friction);
  joint.drive.ambient = TemperatureProfile::constant(temperature_C);
  joint.drive.seed = seed;
  joint.loop.controller.motion = kMotion;
  if (kind == Kind::kJerkLimited) joint.loop.controller.jerk_limit_rad_s3 = kJerk_rad_s3;
  return joint;
}

/// The largest values of all joints on one path.
struct Ride {
  double off_rad = 0.0;                                 ///< of the link, from the path at that time
  double left_rad = 0.0;                                ///< from the path's end, half a second after it
  double acceleration_rad_s2 = 0.0, jerk_rad_s3 = 0.0;  ///< of setpoints
};

Ride ride(const std::vector<KnotPath>& parts, Kind kind, const std::vector<BenchJoint>& joints,
          const std::optional<double>& pause_s) {
  JointBench bench(joints);
  const std::size_t count = parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    bench.bring_to_hold(i, kind == Kind::kSpring ? flexible_table() : demo_table());
    const auto slot =
        bench.joint(i).joint().path_slots.hand_over({7, static_cast<std::int32_t>(count), parts[i]});
    EXPECT_EQ(bench.order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
              Reason::kAccepted);
  }
  EXPECT_EQ(bench.order(0, OrderKind::kResumePath), Reason::kAccepted);
  Ride seen;
  std::vector<double> path_times_s(count), speeds_rad_s(count), accelerations_rad_s2(count);
  const double end_s = parts[0].duration_s() + (pause_s ? kPause_s + 0.5 : 0.0) + 0.7;
  for (int k = 1; k * kPeriod_s < end_s; ++k) {
    if (pause_s && k == std::lround(*pause_s / kPeriod_s))
      (void)bench.order(count - 1, OrderKind::kPausePath);
    else if (pause_s && k == std::lround((*pause_s + kPause_s) / kPeriod_s))
      (void)bench.order(0, OrderKind::kResumePath);
    else
      bench.step();
    for (std::size_t i = 0; i < count; ++i) {
      const state_v1& state = bench.state(i);
      const bool on_path = !std::isnan(state.path_time_s);
      const bool goes_on = on_path && state.path_time_s > path_times_s[i];
      if (on_path) path_times_s[i] = state.path_time_s;
      const double place_rad =
          PathReader().at(parts[i], on_path ? path_times_s[i] : parts[i].duration_s()).position_rad;
      const double off_rad =
          std::abs(bench.drive(i).simulated().plant().link_state().position_rad - place_rad);
      if (on_path) seen.off_rad = std::max(seen.off_rad, off_rad);
      seen.left_rad = i == 0 ? off_rad : std::max(seen.left_rad, off_rad);
      const double rad_s2 = (state.setpoint_velocity_rad_s - speeds_rad_s[i]) / kPeriod_s;
      if (goes_on) {
        seen.acceleration_rad_s2 = std::max(seen.acceleration_rad_s2, std::abs(rad_s2));
        seen.jerk_rad_s3 = std::max(seen.jerk_rad_s3, std::abs(rad_s2 - accelerations_rad_s2[i]) / kPeriod_s);
      }
      speeds_rad_s[i] = state.setpoint_velocity_rad_s;
      accelerations_rad_s2[i] = rad_s2;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_EQ(bench.fault(i), Fault::kNone);
    EXPECT_EQ(bench.mode(i), Mode::kHolding);
  }
  return seen;
}

/// Bounds for joints of one kind with `friction` times the table's friction.
struct Bounds {
  double friction = 1.0;
  double off_rad = 0.0;
  double share_within = 1.0;  ///< share of rides in which no joint is ever 0.5 mrad off
};

void follow_all(Kind kind, const Bounds& bounds) {
  int rides = 0, within = 0;
  double farthest_rad = 0.0;
  for (int round = 0; round < 3; ++round)
    for (const double temperature_C : {-8.0, 5.0, 25.0, 38.0})
      for (const std::size_t joints : {1U, 2U, 6U}) {
        const auto seed =
            static_cast<std::uint64_t>(1000 * round + 10 * static_cast<int>(temperature_C + 8.0)) + joints;
        SCOPED_TRACE(::testing::Message() << "seed " << seed << ", friction " << bounds.friction);
        std::mt19937_64 random(seed);
        const std::vector<KnotPath> parts = draw_path(random, joints);
        std::vector<BenchJoint> benched;
        for (std::size_t i = 0; i < joints; ++i)
          benched.push_back(joint_of(kind, bounds.friction, temperature_C, seed + i));
        std::optional<double> pause_s;
        if (round == 2) pause_s = between(random, 0.01, parts[0].duration_s());
        const Ride seen = ride(parts, kind, benched, pause_s);
        // A link on a spring requires more acceleration of its motor than its own.
        if (kind != Kind::kSpring) {
          EXPECT_LE(seen.acceleration_rad_s2, kMotion.acceleration_rad_s2 * kKept);
        }
        if (kind == Kind::kJerkLimited) {
          EXPECT_LE(seen.jerk_rad_s3, kJerk_rad_s3 * kKept);
        }
        EXPECT_LT(seen.off_rad, bounds.off_rad);
        EXPECT_LT(seen.left_rad, kLeft_rad);
        ++rides;
        within += seen.off_rad < kFarOff_rad ? 1 : 0;
        farthest_rad = std::max(farthest_rad, seen.off_rad);
      }
  std::printf("friction %.1f of the table's: %.2f mrad off at most, %d of %d within 0.5\n", bounds.friction,
              1e3 * farthest_rad, within, rides);
  EXPECT_GE(within, bounds.share_within * rides);
}

// The error of a rigid joint is largest at breakaway and reversal.
TEST(RandomPaths, AreFollowedByRigidJoints) {
  for (const Bounds& bounds : {Bounds{1.0, 0.75e-3, 0.7}, Bounds{0.8, 1e-3, 0.7}, Bounds{1.2, 1e-3, 0.6}})
    follow_all(Kind::kRigid, bounds);
}

TEST(RandomPaths, AreFollowedByJointsWithAJerkLimit) {
  for (const Bounds& bounds : {Bounds{1.0, 1.4e-3, 0.6}, Bounds{1.2, 1.4e-3, 0.3}})
    follow_all(Kind::kJerkLimited, bounds);
}

TEST(RandomPaths, AreFollowedByLinksOnASpring) {
  for (const Bounds& bounds :
       {Bounds{1.0, kFarOff_rad, 1.0}, Bounds{0.8, 1.4e-3, 0.25}, Bounds{1.2, 1.6e-3, 0.1}})
    follow_all(Kind::kSpring, bounds);
}

}  // namespace
}  // namespace strainwave::testing
