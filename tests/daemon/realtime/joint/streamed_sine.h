// SPDX-License-Identifier: BSD-3-Clause
// A sine streamed to the whole loop on the simulated joint.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "control/joint_controller.h"
#include "daemon/realtime/joint/orders.h"

namespace strainwave::testing {

struct StreamedSine {
  int every = 10;  ///< periods
  int derivatives = 0;
  int ahead = 0;  ///< periods by which it is stamped ahead; 0: stamped with the time of sending
  double amplitude_rad = 0.5;
  double rate_Hz = 0.5;
  double load_kgm2 = 0.0;  ///< additional load, which the stream announces

  double omega_rad_s() const { return 2.0 * std::numbers::pi * rate_Hz; }
  /// Periods by which the joint lags behind it.
  double lag() const { return ahead == 0 ? 1e3 * JointControllerConfig{}.stream_delay_s : 0.0; }

  /// The sample of `period` since the beginning of the stream, given before `cycle`.
  Order sample(std::int64_t cycle, std::int64_t period) const {
    const double phase = omega_rad_s() * 1e-3 * static_cast<double>(period + ahead);
    Order order;
    order.kind = OrderKind::kSetpoint;
    order.stream_id = 1;
    order.begins_stream = order.approaches = period == 0;
    order.valid_for_s = 0.2;
    order.position_rad = amplitude_rad * std::sin(phase);
    order.derivatives = derivatives;
    if (derivatives > 0) order.velocity_rad_s = amplitude_rad * omega_rad_s() * std::cos(phase);
    if (derivatives > 1) order.acceleration_rad_s2 = -omega_rad_s() * omega_rad_s() * order.position_rad;
    if (ahead > 0)
      order.at_cycle = cycle + ahead;
    else
      order.sent_us = 1'700'000'000'000'000 + 1000 * period;
    order.load_inertia_kgm2 = load_kgm2;
    return order;
  }
};

}  // namespace strainwave::testing
