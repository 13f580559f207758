// SPDX-License-Identifier: BSD-3-Clause
// The controller with an encoder on the link, behind the gear's spring, and with the table that is certified for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/joint/gear_catalogue.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/flexible_study.h"
#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

constexpr double kDamping_Nms_rad = 1.0;

FlexibleCell cell(double link_kgm2, double delay_periods, double temperature_C, double step_rad) {
  FlexibleCell cell{link_kgm2, 1.0, 0.0, temperature_C, step_rad, "none", realistic_plant(), {}, 4.0};
  Transmission gear;
  gear.link_inertia_kgm2 = link_kgm2;
  gear.spring = find_gear("csf-17-50")->spring;
  gear.damping_Nms_rad = kDamping_Nms_rad;
  cell.nominal.effects.transmission = gear;
  cell.nominal.delay.periods = delay_periods;
  cell.nominal.link_encoder.counts_per_joint_revolution = kReferenceCountsPerRevolution;
  cell.nominal.feedback = EncoderSide::kLink;
  cell.plant = cell.nominal;
  return cell;
}

Contender controller(const GainTable& table) {
  return extended_contender("link", table, {5.0, 60.0, 60.0});
}

struct LinkArrival {
  double error_rad = 0.0;  ///< error of the link at the end
  double swing_rad = 0.0;  ///< peak to peak, in the last second
  double overshoot_rad = 0.0;
  int reversals = 0;  ///< sign changes of a torque of 1 N m and more in the last second
  bool switched_off = false;
  double within_mrad_s = 0.0;  ///< time after which the link stays within a milliradian
};

LinkArrival run(const FlexibleCell& cell, const GainTable& table) {
  const ClosedLoopResult result = run_cell(cell, controller(table));
  LinkArrival arrival;
  arrival.switched_off = result.switched_off_s.has_value();
  double low = INFINITY;
  double high = -INFINITY;
  double side = 0.0;
  for (const TracePoint& point : result.trace) {
    const double error_rad = point.link_position_rad - cell.step_rad;
    arrival.overshoot_rad = std::max(arrival.overshoot_rad, error_rad);
    if (std::abs(error_rad) > 1e-3) arrival.within_mrad_s = point.time_s;
    arrival.error_rad = error_rad;
    if (point.time_s < cell.duration_s - 1.0) continue;
    low = std::min(low, error_rad);
    high = std::max(high, error_rad);
    if (std::abs(point.wanted_torque_Nm) < 1.0) continue;
    if (side * point.wanted_torque_Nm < 0.0) ++arrival.reversals;
    side = point.wanted_torque_Nm;
  }
  arrival.swing_rad = high - low;
  return arrival;
}

// The links of 0.05 and 0.3 kg m2 are outside the table's box.
TEST(LinkEncoder, ArrivesWithoutOscillatingWhateverTheLink) {
  const GainTable table = testing::shipped_table("csf-17-50-link");
  for (int delay = table.box.least_delay; delay <= table.box.most_delay; ++delay) {
    for (const double link_kgm2 : {0.05, 0.085, 0.1, 0.115, 0.3}) {
      for (const double temperature_C : {-10.0, 20.0, 40.0}) {
        for (const double step_rad : {0.001, 0.01, 0.1, 1.0}) {
          const LinkArrival arrival = run(cell(link_kgm2, delay, temperature_C, step_rad), table);
          SCOPED_TRACE(::testing::Message() << "delay " << delay << ", link " << link_kgm2 << " kg m2, "
                                            << temperature_C << " degC, " << step_rad << " rad");
          EXPECT_FALSE(arrival.switched_off);
          EXPECT_LT(std::abs(arrival.error_rad), 0.5e-3);
          EXPECT_LT(arrival.swing_rad, 20e-6) << "two counts";
          EXPECT_EQ(arrival.reversals, 0);
          EXPECT_LT(arrival.overshoot_rad, 2e-3);
          EXPECT_LT(arrival.within_mrad_s, 0.4);
        }
      }
    }
  }
}

}  // namespace
}  // namespace strainwave
