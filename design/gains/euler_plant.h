// SPDX-License-Identifier: BSD-3-Clause
// The joint sampled by forward Euler, as in Zhao (2006), to reproduce that paper. Offline. A real joint does
// not move like this between samples; design/gains/ts_plant.h has the exact solution.
#pragma once

#include "design/gains/ts_plant.h"

namespace strainwave {

/// One rule: [theta, w] -> (I + ts Ac, ts Bc), the integral as in design/gains/ts_plant.h. Zhao (2006), (3-14).
BoundedDynamics euler_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                               bool has_integrator) noexcept;

}  // namespace strainwave
