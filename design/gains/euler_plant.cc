// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/euler_plant.h"

namespace strainwave {

BoundedDynamics euler_dynamics(const PlantIdentity& plant, double viscous_Nms_rad,
                               bool has_integrator) noexcept {
  const Bounded period = plant.period_s;
  BoundedDynamics dynamics;
  dynamics.A[1][1] = 1.0;
  if (has_integrator) {
    dynamics.A[0][0] = 1.0;
    dynamics.A[0][1] = period;
  }
  dynamics.A[1][2] = period;
  dynamics.A[2][2] = Bounded(1.0) - period * viscous_Nms_rad / plant.inertia_kgm2;
  dynamics.B[2] = period / plant.inertia_kgm2;
  return dynamics;
}

}  // namespace strainwave
