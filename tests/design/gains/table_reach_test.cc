// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/table_reach.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "control/table/box_certificate.h"
#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

constexpr double kLimit_Nm = 34.0;

// Matrices of fixed size are ten times as fast.
using LoopMatrix = Eigen::Matrix<double, 7, 7>;
using LoopState = Eigen::Matrix<double, 7, 1>;

const GainTable& shipped() {
  static const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/csf-17-50.json");
  return table;
}

/// Computed once, because it takes ten seconds.
const TableReach& shipped_reach() {
  static const TableReach reach = reach_of(shipped());
  return reach;
}

// Simulates one joint under one gain. The torque acts one period late and is limited.
class TableReachTest : public ::testing::Test {
 protected:
  double any(const BoxRange& range) {
    return std::uniform_real_distribution<double>(range.from, range.to)(random_);
  }

  void choose_joint() {
    cell_ = table_.box.cells[random_() % static_cast<std::size_t>(table_.box.cell_count)];
    const SpringBox box = spring_box(table_, cell_);
    const SpringPlant plant{any(box.motor_inertia_kgm2), any(box.link_inertia_kgm2),
                            any(box.stiffness_Nm_rad), any(box.damping_Nms_rad), any(box.viscous_Nms_rad)};
    sampled_ = spring_exponential(spring_generator(plant, table_.plant.period_s));
    P_ = lyapunov_of(table_, cell_);
    const std::vector<GainRow> gains = gains_of(table_);
    choose_gain(gains[random_() % gains.size()]);
  }

  void choose_gain(const GainRow& gain) {
    H_ = spring_loop(sampled_, gain, loop_of(table_, 1)).value;
    by_torque_ = sampled_.value.col(4).head(4);
  }

  static LoopState at_rest(double error_rad) {
    LoopState x = LoopState::Zero();
    x(1) = x(5) = error_rad;
    return x;
  }

  // `at_motor_Nm` is a torque that the control law does not know.
  void step(LoopState& x, double at_motor_Nm = 0.0) const {
    x = (H_ * x).eval();
    x(6) = std::clamp(x(6), -kLimit_Nm, kLimit_Nm);
    x.segment<4>(1) += at_motor_Nm * by_torque_;
  }

  double level(const LoopState& x) const { return x.dot(P_ * x); }

  const GainTable& table_ = shipped();
  const TableReach& reach_ = shipped_reach();
  BoxCell cell_;
  BoundedMatrix sampled_;
  LoopMatrix H_;
  LoopMatrix P_;
  Eigen::Vector4d by_torque_;
  std::mt19937_64 random_{7};
};

TEST_F(TableReachTest, AStepOrAnyOtherCourseOfUnknownTorqueStaysWithinTheStandOff) {
  for (int joint = 0; joint < 50; ++joint) {
    choose_joint();
    LoopState by_step = at_rest(0.0);
    LoopState by_walk = at_rest(0.0);
    double walk_Nm = 1.0;
    for (int k = 0; k < 1000; ++k) {
      if (random_() % 20 == 0) walk_Nm = -walk_Nm;
      step(by_step, 1.0);
      step(by_walk, walk_Nm);
      ASSERT_LE(std::abs(by_step(1)), reach_.motor_rad_per_Nm);
      ASSERT_LE(std::abs(by_walk(1)), reach_.motor_rad_per_Nm);
    }
  }
}

TEST_F(TableReachTest, TheWorstCourseReachesTheStandOff) {
  double worst_rad = 0.0;
  for (int i = 0; i < table_.box.cell_count; ++i) {
    const SpringBox box = spring_box(table_, table_.box.cells[static_cast<std::size_t>(i)]);
    for (const SpringCorner& corner : spring_corners(box, table_.plant.period_s).corners) {
      sampled_ = corner.sampled;
      for (const GainRow& gain : gains_of(table_)) {
        choose_gain(gain);
        std::vector<double> response;
        LoopState x = at_rest(0.0);
        for (int k = 0; k < 14000; ++k) {
          step(x, k == 0 ? 1.0 : 0.0);
          response.push_back(x(1));
        }
        x = at_rest(0.0);
        for (auto at = response.rbegin(); at != response.rend(); ++at) step(x, *at < 0.0 ? -1.0 : 1.0);
        worst_rad = std::max(worst_rad, x(1));
      }
    }
  }
  EXPECT_LE(worst_rad, 1.001 * reach_.motor_rad_per_Nm);
  EXPECT_GE(worst_rad, 0.98 * reach_.motor_rad_per_Nm);
}

TEST_F(TableReachTest, FromTheRegionVFallsAndTheLoopReturns) {
  for (int joint = 0; joint < 100; ++joint) {
    choose_joint();
    LoopState x = at_rest(kLimit_Nm * reach_.position_rad_per_Nm);
    if (joint % 2 == 1) {
      x.setZero();
      x(2) = kLimit_Nm * reach_.velocity_rad_s_per_Nm;
      x(5) = -table_.plant.period_s * x(2);
    }
    const std::vector<GainRow> gains = gains_of(table_);
    double last = level(x);
    for (int k = 0; k < 5000; ++k) {
      choose_gain(gains[random_() % gains.size()]);
      step(x);
      ASSERT_LE(level(x), last);
      last = level(x);
    }
    EXPECT_LT(std::abs(x(1)), 1e-4);
  }
}

// Shows why the region is needed: far outside of it V rises.
TEST_F(TableReachTest, FarOutsideTheRegionALimitedTorqueLetsVRise) {
  bool rises = false;
  for (int joint = 0; joint < 20; ++joint) {
    choose_joint();
    LoopState x = at_rest(0.0);
    x(2) = 30.0 * kLimit_Nm * reach_.velocity_rad_s_per_Nm;
    x(5) = -table_.plant.period_s * x(2);
    double last = level(x);
    for (int k = 0; k < 1000; ++k) {
      step(x);
      rises = rises || level(x) > last;
      last = level(x);
    }
  }
  EXPECT_TRUE(rises);
}

TEST(TableReach, SaysItsNumbersForTheTorqueThatIsLeft) {
  const std::string text = describe({0.002, 0.003, 0.0004, 0.02}, kLimit_Nm);
  EXPECT_NE(text.find("stand-off"), std::string::npos) << text;
  EXPECT_NE(text.find("34 N m"), std::string::npos) << text;
}

}  // namespace
}  // namespace strainwave
