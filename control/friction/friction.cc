// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/friction.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace strainwave {

double stribeck_friction_Nm(const FrictionParameters& friction, const StribeckShape& shape,
                            double velocity_rad_s) noexcept {
  const double speed = std::abs(velocity_rad_s);
  const double ratio = speed / shape.velocity_rad_s;
  const double exponent = shape.exponent == 2.0 ? ratio * ratio : std::pow(ratio, shape.exponent);
  const double stribeck = (friction.static_Nm - friction.coulomb_Nm) * std::exp(-exponent);
  return (stribeck + friction.coulomb_Nm + friction.viscous_Nms_rad * speed) * sign(velocity_rad_s);
}

FrictionParameters ExponentialTemperatureLaw::at(double temperature_C) const noexcept {
  const double decay = std::exp(-(temperature_C - reference_C) / decay_C);
  return {std::max(0.0, asymptote.static_Nm + amplitude.static_Nm * decay),
          std::max(0.0, asymptote.coulomb_Nm + amplitude.coulomb_Nm * decay),
          std::max(0.0, asymptote.viscous_Nms_rad + amplitude.viscous_Nms_rad * decay)};
}

}  // namespace strainwave
