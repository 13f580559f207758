// SPDX-License-Identifier: BSD-3-Clause
// The daemon's loop over the simulated drive on a joint with a spring, beside the study of such joints: what the study says of the
// default controller is what the daemon does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/studies/flexible_study.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

struct Figures {
  double link_pi2 = 0.0;  ///< sum of |e / r| above 40 urad
  double overshoot_rad = 0.0;
  double peak_Nm = 0.0;

  void add(double link_rad, double torque_Nm, double step_rad) {
    const double error_rad = step_rad - link_rad;
    if (std::abs(error_rad) > 40e-6) link_pi2 += std::abs(error_rad / step_rad);
    overshoot_rad = std::max(overshoot_rad, -error_rad);
    peak_Nm = std::max(peak_Nm, std::abs(torque_Nm));
  }
};

const GainTable& table_of(const FlexibleCell& cell) {
  static const FlexibleTables tables =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  return FlexibleTables::nearest(tables.c4, cell.plant.joint.inertia_kgm2 + cell.link_inertia_kgm2);
}

Figures by_the_study(const FlexibleCell& cell) {
  Figures figures;
  for (const TracePoint& point : run_cell(cell, extended_contender("daemon", table_of(cell))).trace)
    figures.add(point.link_position_rad, point.wanted_torque_Nm, cell.step_rad);
  return figures;
}

Figures by_the_loop(const FlexibleCell& cell) {
  BenchJoint joint = demo_joint();
  put_on_spring(joint, cell.plant);
  joint.drive.ambient = TemperatureProfile::constant(cell.temperature_C);
  joint.drive.temperature_noise_C = 0.0;
  joint.loop.controller.motion = kNoMotionLimits;
  joint.loop.limits.overspeed_rad_s = 100.0;
  joint.loop.limits.following_error_rad = 10.0;
  JointBench bench({joint});
  bench.bring_to_hold(0, table_of(cell));
  bench.run(3.0);  // the temperature must have been good for a while
  Figures figures;
  for (int k = 0; k < 2000; ++k) {
    if (k > 0)
      bench.step();
    else
      EXPECT_EQ(bench.move(0, cell.step_rad), Reason::kAccepted);
    figures.add(bench.drive(0).simulated().plant().link_state().position_rad,
                bench.drive(0).command().torque_Nm, cell.step_rad);
  }
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  return figures;
}

TEST(JointLoopOnASpring, MovesTheLinkAsTheStudySaysWithinOnePerCent) {
  int cells = 0;
  for (const FlexibleCell& cell : flexible_grid()) {
    if (cell.stiffness_scale != 1.0 || cell.damping_ratio != 0.03 || cell.temperature_C != 20.0) continue;
    if (cell.link_inertia_kgm2 > 0.5 || cell.step_rad < 0.005) continue;
    ++cells;
    const Figures study = by_the_study(cell);
    const Figures loop = by_the_loop(cell);
    const auto what = ::testing::Message() << cell.link_inertia_kgm2 << " kg m2, " << cell.step_rad << " rad";
    EXPECT_NEAR(loop.link_pi2 / study.link_pi2, 1.0, 0.01) << what;
    EXPECT_NEAR(loop.overshoot_rad, study.overshoot_rad, 0.01 * study.overshoot_rad + 20e-6) << what;
    EXPECT_NEAR(loop.peak_Nm / study.peak_Nm, 1.0, 0.01) << what;
  }
  EXPECT_EQ(cells, 9);
}

}  // namespace
}  // namespace strainwave::testing
