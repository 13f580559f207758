// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/planned_peer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/joint/reference_plant.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/peers/cascade.h"

namespace strainwave {
namespace {

ClosedLoopResult run_step(const Contender& contender, const JointPlantConfig& plant, double step_rad) {
  ClosedLoopConfig loop;
  loop.plant = plant;
  loop.ambient = TemperatureProfile::constant(20.0);
  loop.setpoint_rad = TimeProfile::constant(step_rad, {"setpoint_position_rad"});
  loop.duration_s = 2.0;
  const auto controller = contender.make(plant);
  return run_closed_loop(loop, *controller);
}

TEST(PlannedPeer, BringsTheLinkToItsTargetWithEachOfThePeers) {
  ASSERT_EQ(peer_contenders().size(), 5U);
  for (const Contender& contender : peer_contenders())
    for (const double step_rad : {0.1, 1.0}) {
      const auto trace = on_the_link(run_step(contender, flexible_plant(), step_rad).trace);
      EXPECT_NEAR(trace.back().joint_position_rad, step_rad, 1e-3) << contender.name;
      for (const TracePoint& point : trace)
        ASSERT_LT(point.joint_position_rad, 1.05 * step_rad) << contender.name;
    }
}

// docs/flexible-joint.md states this for nearly every cell with links up to three times the motor's inertia.
TEST(PlannedPeer, IsNowhereBetterThanTheDaemonToldOfItsSpringInTheMiddleOfTheGrid) {
  std::vector<FlexibleCell> cells;
  for (const FlexibleCell& cell : flexible_grid())
    if (cell.damping_ratio == 0.03 && cell.stiffness_scale == 1.0 && cell.temperature_C == 0.0 &&
        cell.link_inertia_kgm2 < 0.3)
      cells.push_back(cell);
  std::vector<Contender> contenders = peer_contenders();
  const auto tables = read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  for (const Contender& contender : flexible_contenders(tables, false))
    if (contender.name == "daemon") contenders.push_back(contender);
  for (const FlexibleRow& row : run_flexible(cells, contenders, [](std::size_t) {}))
    for (std::size_t peer = 0; peer + 1 < contenders.size(); ++peer)
      EXPECT_LT(row.results.back().link_counted_ratio, row.results[peer].link_counted_ratio)
          << contenders[peer].name << ", link " << row.cell.link_inertia_kgm2 << ", " << row.cell.step_rad;
}

// Without feed-forward a position loop lags by its gain: v / kp.
TEST(CascadePeer, LagsAMotionWithoutFeedForwardAndNotWithIt) {
  JointPlantConfig plant = realistic_plant();
  plant.joint.friction.asymptote = plant.joint.friction.amplitude = {0.0, 0.0, 0.0};
  const ServoJoint servo = servo_joint(plant);
  for (const bool feedforward : {false, true}) {
    CascadePeer peer(servo, feedforward);
    JointPlant joint(plant);
    peer.reset(0.0);
    double lag_rad = 0.0;
    for (int k = 0; k < 1000; ++k) {
      joint.set_ambient_temperature(20.0);
      const double position_rad = 0.5 * k * plant.period_s;
      joint.step(peer.step({position_rad, 0.5, 0.0}, joint.measured_position_rad()));
      lag_rad = position_rad + 0.5 * plant.period_s - joint.state().position_rad;
    }
    EXPECT_NEAR(lag_rad, feedforward ? 0.0 : 0.5 / (0.25 * velocity_bandwidth_rad_s(servo)), 1e-3);
  }
}

TEST(CascadePeer, AsksForNothingAtTheResonanceBehindItsNotch) {
  const ServoJoint joint = servo_joint(flexible_plant());
  // Half of the peak-to-peak torque, since the start of the swing leaves a constant offset.
  const auto swing_Nm = [&](ServoPeer& peer) {
    double low_Nm = 1e9;
    double high_Nm = -1e9;
    peer.reset(0.0);
    for (int k = 0; k < 4000; ++k) {
      const double reading_rad = 1e-3 * std::sin(joint.resonance_rad_s * joint.period_s * k);
      const double torque_Nm = peer.step({0.0, 0.0, 0.0}, reading_rad);
      if (k < 3000) continue;
      low_Nm = std::min(low_Nm, torque_Nm);
      high_Nm = std::max(high_Nm, torque_Nm);
    }
    return 0.5 * (high_Nm - low_Nm);
  };
  CascadePeer plain(joint, true);
  EXPECT_GT(swing_Nm(plain), 5.0);
  EXPECT_LT(swing_Nm(*notched_cascade(joint)), 1e-6);
}

}  // namespace
}  // namespace strainwave
