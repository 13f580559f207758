// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/inertia_estimate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "control/joint_controller.h"
#include "tests/support/scaled_table.h"
#include "tests/support/two_mass_joint.h"

namespace strainwave::testing {
namespace {

/// The table of the catalogue's joint, scaled to another inertia.
GainTable table_for(double inertia_kgm2) {
  return scaled_table("c4.json", inertia_kgm2);
}

/// Configuration of a joint with this total inertia. Its spring is as stiff as that of the simulated joint.
JointControllerConfig config_for(double total_kgm2, double count_rad) {
  JointControllerConfig config;
  config.encoder_resolution_rad = count_rad;
  config.delay_periods = 1;
  config.torque_limit_Nm = 34.0;
  config.motor = {34.0, 150.0, 18.3};
  config.motion = {5.0, 60.0, 60.0};
  config.link = {0.089, total_kgm2 - 0.089, TorsionSpring::linear(1e4), 1.0, {}};
  return config;
}

struct Case {
  TwoMassData joint;
  double told_kgm2 = 0.178;  ///< inertia of the table and the configuration
  double temperature_C = 20.0;
  double load_Nm = 0.0;  ///< load that the controller does not know
};

/// Friction of `table` at this temperature, multiplied by `factor`.
TwoMassData with_friction(const GainTable& table, double temperature_C, double factor) {
  const FrictionParameters friction = table.friction.blend(table.friction.weights(temperature_C));
  TwoMassData data;
  data.static_Nm = factor * friction.static_Nm;
  data.coulomb_Nm = factor * friction.coulomb_Nm;
  data.viscous_Nms_rad = factor * friction.viscous_Nms_rad;
  data.stribeck_rad_s = 0.5 * table.friction.velocity.zero_width_rad_s;
  return data;
}

/// The daemon's controller moves the joint, one second per target, and the estimate observes it.
class Watched {
 public:
  explicit Watched(const Case& what)
      : table_(table_for(what.told_kgm2)),
        what_(what),
        joint_(what.joint),
        controller_(config_for(what.told_kgm2, joint_.count_rad())),
        estimate_({0.001, joint_.count_rad(), 1}) {
    controller_.load(table_);
    controller_.start(joint_.reading_rad());
    model_.friction = table_.friction.blend(table_.friction.weights(what.temperature_C));
    model_.stribeck = {0.5 * table_.friction.velocity.zero_width_rad_s, 2.0};
  }
  void move(const std::vector<double>& targets) {
    for (const double target_rad : targets) {
      controller_.set_target(target_rad);
      for (int k = 0; k < 1000; ++k) {
        estimate_.step({joint_.reading_rad(), torque_Nm_, 0.0}, model_);
        JointMeasurement measurement;
        measurement.joint_position_rad = joint_.reading_rad();
        measurement.temperature_C = what_.temperature_C;
        measurement.temperature_valid = true;
        torque_Nm_ = controller_.step(measurement).output.torque_Nm;
        joint_.step(torque_Nm_, -what_.load_Nm);
      }
    }
  }
  const InertiaEstimate& estimate() const { return estimate_; }
  InertiaEstimate& estimate() { return estimate_; }

 private:
  GainTable table_;
  Case what_;
  TwoMassJoint joint_;
  JointController controller_;
  InertiaEstimate estimate_;
  JointModel model_;
  double torque_Nm_ = 0.0;
};

TEST(InertiaEstimate, FindsWhatHangsOnTheSpringWhateverIsConfigured) {
  for (const double link_kgm2 : {0.0, 0.03, 0.089, 0.267})
    for (const double temperature_C : {-5.0, 20.0, 40.0})
      for (const double factor : {0.7, 1.0, 1.3})
        for (const double load_Nm : {0.0, 2.0}) {
          Case what;
          what.temperature_C = temperature_C;
          what.joint = with_friction(table_for(what.told_kgm2), temperature_C, factor);
          what.joint.link_kgm2 = link_kgm2;
          what.joint.damping_Nms_rad = 1.0;
          what.load_Nm = load_Nm;
          Watched watched(what);
          watched.move({0.2, 0.0, 0.5, 0.0});
          const double true_kgm2 = what.joint.motor_kgm2 + link_kgm2;
          SCOPED_TRACE(::testing::Message()
                       << link_kgm2 << " kg m2, " << temperature_C << " degC, friction x " << factor
                       << ", load " << load_Nm << " N.m");
          const auto found = watched.estimate().inertia_kgm2();
          ASSERT_TRUE(found);
          EXPECT_NEAR(*found, true_kgm2, 0.06 * true_kgm2);
        }
}

// The windows of the estimate last the same time at every period.
TEST(InertiaEstimate, IsTheSameForFasterAndSlowerLoops) {
  for (const double period_s : {1e-4, 2.5e-4, 1e-3, 4e-3}) {
    constexpr double kInertia_kgm2 = 0.2;
    InertiaEstimate estimate({period_s, 2e-5, 2});
    JointModel model;
    model.friction.static_Nm = 1.0;
    double position_rad = 0.0;
    double velocity_rad_s = 0.5;
    std::array<double, 3> torques_Nm{};
    const int periods = static_cast<int>(3.0 / period_s);
    for (int k = 0; k < periods; ++k) {
      std::rotate(torques_Nm.begin(), torques_Nm.end() - 1, torques_Nm.end());
      torques_Nm[0] = 2.0 * std::cos(20.0 * k * period_s);
      const double gained_rad_s = torques_Nm[2] / kInertia_kgm2 * period_s;
      position_rad += period_s * (velocity_rad_s + 0.5 * gained_rad_s);
      velocity_rad_s += gained_rad_s;
      estimate.step({2e-5 * std::nearbyint(position_rad / 2e-5), torques_Nm[0], 0.0}, model);
    }
    ASSERT_TRUE(estimate.inertia_kgm2()) << period_s;
    EXPECT_NEAR(*estimate.inertia_kgm2(), kInertia_kgm2, 0.03 * kInertia_kgm2) << period_s;
  }
}

}  // namespace
}  // namespace strainwave::testing
