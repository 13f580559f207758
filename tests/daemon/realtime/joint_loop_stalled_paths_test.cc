// Joints on a path whose loop is away for longer than anybody knows what they did: they go on along it from where they are. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "daemon/realtime/path_follower.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr OverrunLimits kPatient{1000, 2.0, 1.0};
constexpr double kFastest_rad_s = 0.75;
constexpr double kDuration_s = 2.0;

enum class Drives {
  kGoOn,  ///< under the last torque
  kStop,  ///< without torque after 5 ms
};
std::ostream& operator<<(std::ostream& out, Drives drives) {
  return out << (drives == Drives::kGoOn ? "go on" : "stop");
}

/// Up in a second at up to this joint's share of kFastest_rad_s, and back: how far is each joint's own, so that they are nowhere twice.
KnotPath hill(std::size_t joint) {
  const double far_rad = kFastest_rad_s * 2.0 / 3.0 * (1.0 - 0.25 * static_cast<double>(joint));
  KnotPath path;
  path.count = 3;
  path.knots[1] = {0.5 * kDuration_s, far_rad, 0.0};
  path.knots[2] = {kDuration_s, (0.2 + 0.3 * static_cast<double>(joint)) * far_rad, 0.0};
  return path;
}

class StalledPath {
 public:
  explicit StalledPath(std::vector<BenchJoint> joints, const GainTable& table = demo_table())
      : bench_(joints, kPatient), count_(joints.size()) {
    for (std::size_t i = 0; i < count_; ++i) bench_.bring_to_hold(i, table);
    for (std::size_t i = 0; i < count_; ++i) {
      const auto slot =
          bench_.joint(i).path_slots().hand_over({7, static_cast<std::int32_t>(count_), hill(i)});
      EXPECT_EQ(bench_.order(i, Order{.kind = OrderKind::kLoadPath, .path_slot = slot.value_or(0)}),
                Reason::kAccepted);
    }
    EXPECT_EQ(bench_.order(0, OrderKind::kResumePath), Reason::kAccepted);
  }
  JointBench& bench() { return bench_; }
  void step() {
    bench_.step();
    for (std::size_t i = 0; i < count_; ++i)
      fastest_rad_s_ = std::max(fastest_rad_s_, std::abs(bench_.state(i).setpoint_velocity_rad_s) /
                                                    (1.0 - 0.25 * static_cast<double>(i)));
  }
  void run(double duration_s) {
    for (int k = 0; k < std::lround(1e3 * duration_s); ++k) step();
  }
  /// Of all setpoints, as if each were the first joint's.
  double fastest_rad_s() const { return fastest_rad_s_; }
  /// The time of the path that is nearest to the joints, and how far the farthest is from it.
  double nearest_s(double* farthest_rad = nullptr) {
    double best_s = 0.0;
    double least_rad = 1e9;
    for (double s = 0.0; s <= kDuration_s; s += 1e-4) {
      double here_rad = 0.0;
      for (std::size_t i = 0; i < count_; ++i)
        here_rad = std::max(here_rad, std::abs(PathReader().at(hill(i), s).position_rad -
                                               bench_.state(i).joint_position_rad));
      if (here_rad >= least_rad) continue;
      least_rad = here_rad;
      best_s = s;
    }
    if (farthest_rad != nullptr) *farthest_rad = least_rad;
    return best_s;
  }
  bool all_hold_at_the_end() const {
    for (std::size_t i = 0; i < count_; ++i)
      if (bench_.mode(i) != Mode::kHolding ||
          std::abs(bench_.state(i).joint_position_rad - hill(i).last().position_rad) > 1e-3)
        return false;
    return true;
  }

 private:
  JointBench bench_;
  std::size_t count_;
  double fastest_rad_s_ = 0.0;
};

std::vector<BenchJoint> three(Drives drives) {
  BenchJoint joint = demo_joint();
  if (drives == Drives::kStop) joint.drive.watchdog_s = 0.005;
  return {3, joint};
}

// Its time jumped over the stall, and what the drives had not done was made up for at several times its speed.
TEST(StalledPath, GoesOnFromWhereTheJointsAreAtItsOwnSpeed) {
  double fastest_rad_s = 0.0;
  for (const Drives drives : {Drives::kGoOn, Drives::kStop})
    for (const double after_s : {0.1, 0.3, 0.5, 0.8, 0.95, 1.3, 1.7})
      for (const int periods : {25, 40, 120, 400}) {
        // For longer no drive goes on without an order.
        if (drives == Drives::kGoOn && periods > 40) continue;
        StalledPath path(three(drives));
        path.run(after_s);
        path.bench().stall(periods);
        path.step();
        const double left_s = path.nearest_s();
        path.run(0.25);
        double farthest_rad = 0.0;
        const double on_s = path.nearest_s(&farthest_rad);
        EXPECT_LT(farthest_rad, 5e-4) << drives << ", " << after_s << " s, " << periods;
        EXPECT_LT(on_s - left_s, 0.26) << drives << ", " << after_s << " s, " << periods;
        path.run(2.5);
        EXPECT_TRUE(path.all_hold_at_the_end()) << drives << ", " << after_s << " s, " << periods;
        EXPECT_LT(path.fastest_rad_s(), 1.12 * kFastest_rad_s)
            << drives << ", " << after_s << " s, " << periods;
        fastest_rad_s = std::max(fastest_rad_s, path.fastest_rad_s());
      }
  std::printf("setpoints at most at %.3f rad/s, the path's are at %.3f\n", fastest_rad_s, kFastest_rad_s);
}

TEST(StalledPath, OnASpringGoesOnFromWhereTheJointIsAtItsOwnSpeed) {
  double fastest_rad_s = 0.0;
  for (const bool told : {true, false})
    for (const double after_s : {0.1, 0.5, 0.8, 1.3}) {
      StalledPath path({flexible_joint(told), flexible_joint(told)}, flexible_table());
      path.run(after_s);
      path.bench().stall(40);
      path.run(3.0);
      EXPECT_TRUE(path.all_hold_at_the_end()) << told << ", " << after_s << " s";
      EXPECT_LT(path.fastest_rad_s(), 1.12 * kFastest_rad_s) << told << ", " << after_s << " s";
      fastest_rad_s = std::max(fastest_rad_s, path.fastest_rad_s());
    }
  std::printf("on springs: setpoints at most at %.3f rad/s, the path's are at %.3f\n", fastest_rad_s,
              kFastest_rad_s);
}

TEST(StalledPath, ThatIsPausedStaysPaused) {
  StalledPath path(three(Drives::kGoOn));
  path.run(0.5);
  ASSERT_EQ(path.bench().order(1, OrderKind::kPausePath), Reason::kAccepted);
  path.run(0.3);
  const double paused_s = path.nearest_s();
  path.bench().stall(40);
  path.run(0.5);
  EXPECT_NEAR(path.nearest_s(), paused_s, 2e-3);
  EXPECT_EQ(path.bench().mode(0), Mode::kTracking);
  ASSERT_EQ(path.bench().order(2, OrderKind::kResumePath), Reason::kAccepted);
  path.run(2.0);
  EXPECT_TRUE(path.all_hold_at_the_end());
}

TEST(StalledPath, ThatIsToEndRestsAlongIt) {
  StalledPath path(three(Drives::kGoOn));
  path.run(0.5);
  ASSERT_EQ(path.bench().order(1, OrderKind::kHold), Reason::kAccepted);
  path.run(0.03);
  path.bench().stall(40);
  path.run(0.5);
  double farthest_rad = 0.0;
  (void)path.nearest_s(&farthest_rad);
  EXPECT_LT(farthest_rad, 1e-3);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(path.bench().mode(i), Mode::kHolding) << i;
}

// The loop is back, and away again before it has led anybody.
TEST(StalledPath, GoesOnAfterOneStallUponAnother) {
  StalledPath path(three(Drives::kStop));
  path.run(0.5);
  path.bench().stall(40);
  path.step();
  path.bench().stall(60);
  path.step();
  path.bench().stall(3);
  path.run(3.0);
  EXPECT_TRUE(path.all_hold_at_the_end());
  EXPECT_LT(path.fastest_rad_s(), 1.12 * kFastest_rad_s);
}

TEST(StalledPath, BeginsAfterAStallInTheCycleOfItsStart) {
  StalledPath path(three(Drives::kGoOn));
  path.bench().stall(40);
  path.step();
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(path.bench().mode(i), Mode::kHolding) << i;
  path.run(2.2);
  EXPECT_TRUE(path.all_hold_at_the_end());
  EXPECT_LT(path.fastest_rad_s(), 1.001 * kFastest_rad_s);
}

}  // namespace
}  // namespace strainwave::testing
