// A joint that chatters, in the daemon's loop: said, fallen back, and ended by a fault if it goes on.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/joint_bench.h"
#include "tests/support/scaled_table.h"

namespace strainwave::testing {
namespace {

/// A drive so late that no gain of the table is stable, and a configuration that does not know it.
BenchJoint late_joint(double delay_periods) {
  BenchJoint joint = demo_joint();
  joint.drive.plant.delay.periods = delay_periods;
  return joint;
}

struct Ending {
  double factor = 1.0;  ///< of the joint's inertia, in the table
  double delay_periods = 0.0;
};
std::ostream& operator<<(std::ostream& out, const Ending& c) {
  return out << "table for " << c.factor << " times the inertia, " << c.delay_periods << " periods late";
}

class EndOfChatter {
 public:
  /// A move, until the joint is said to chatter.
  explicit EndOfChatter(const Ending& c) : bench_({late_joint(c.delay_periods)}) {
    bench_.bring_to_hold(0, scaled_table("c4.json", 0.089 * c.factor));
    EXPECT_EQ(bench_.move(0, 0.02), Reason::kAccepted);
    EXPECT_GE(bench_.step_until([&] { return bench_.has_notice(0, Notice::kPlainLaw); }, 300), 0) << c;
    EXPECT_EQ(bench_.mode(0), Mode::kTracking) << c << ": said before it is ended";
  }
  /// Periods until the fault; -1: none in so many.
  std::int64_t until_fault(std::int64_t limit) {
    return bench_.step_until([&] { return bench_.mode(0) == Mode::kFaulted; }, limit);
  }
  double travel_rad(int periods) {
    double low_rad = 1e9;
    double high_rad = -1e9;
    for (int k = 0; k < periods; ++k) {
      bench_.step();
      low_rad = std::min(low_rad, bench_.state(0).joint_position_rad);
      high_rad = std::max(high_rad, bench_.state(0).joint_position_rad);
    }
    return high_rad - low_rad;
  }
  JointBench& bench() { return bench_; }

 private:
  JointBench bench_;
};

TEST(JointLoopChatter, ThatThePlainLawEndsLeavesAJointAtRestWithoutAFault) {
  for (const Ending& c : {Ending{1.0, 5.0}, {1.0, 7.0}, {3.0, 2.0}, {6.0, 2.0}, {10.0, 1.0}}) {
    EndOfChatter end(c);
    EXPECT_EQ(end.until_fault(500), -1) << c;
    EXPECT_LT(end.travel_rad(500), 1e-3) << c;
    EXPECT_EQ(end.bench().mode(0), Mode::kHolding) << c;
    EXPECT_TRUE(end.bench().has_notice(0, Notice::kPlainLaw)) << c;
  }
}

TEST(JointLoopChatter, ThatGoesOnIsEndedByItsOwnFault) {
  for (const Ending& c : {Ending{6.0, 5.0}, {6.0, 6.0}, {10.0, 6.0}, {12.0, 4.0}}) {
    EndOfChatter end(c);
    const std::int64_t periods = end.until_fault(500);
    // A tenth of a second of the law's gains, another of a quarter of them, and the time to see either.
    EXPECT_GE(periods, 200) << c;
    EXPECT_LE(periods, 350) << c;
    EXPECT_EQ(end.bench().fault(0), Fault::kChatter) << c;
    EXPECT_EQ(end.bench().drive(0).command().torque_Nm, 0.0) << c;
  }
}

TEST(JointLoopChatter, ThatSwingsTheJointOffItsReferenceIsEndedByTheFollowingErrorBefore) {
  for (const Ending& c : {Ending{6.0, 10.0}, {10.0, 10.0}, {12.0, 10.0}}) {
    EndOfChatter end(c);
    const std::int64_t periods = end.until_fault(500);
    EXPECT_GE(periods, 0) << c;
    EXPECT_LE(periods, 100) << c;
    EXPECT_EQ(end.bench().fault(0), Fault::kFollowingError) << c;
    EXPECT_EQ(end.bench().drive(0).command().torque_Nm, 0.0) << c;
  }
}

TEST(JointLoopChatter, IsNotSaidOfTheSoundJoint) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  for (const double target_rad : {0.001, 0.5, -1.0, -0.999}) {
    ASSERT_EQ(bench.move(0, target_rad), Reason::kAccepted);
    for (int k = 0; k < 1500; ++k) {
      bench.step();
      ASSERT_FALSE(bench.has_notice(0, Notice::kPlainLaw)) << target_rad << ", " << k;
    }
  }
}

}  // namespace
}  // namespace strainwave::testing
