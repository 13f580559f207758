// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/physical_limit.h"

#include <cmath>
#include <string>

#include "base/input_error.h"
#include "base/printable.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

namespace {

void require_none(const char* key, double value) {
  if (value != 0.0)
    throw InputError("physical limit", key, number_text(value),
                     "0 is allowed: the physical limit does not include this effect");
}

/// Refuses the effects that neither limit covers.
void require_no_effects(const JointPlantConfig& plant) {
  const JointEffects& effects = plant.effects;
  require_none("gravity.torque_Nm", effects.gravity.torque_Nm);
  require_none("contact.stiffness_Nm_rad", effects.contact.stiffness_Nm_rad);
  require_none("sliding.presliding_rad", effects.friction.presliding_rad);
  require_none("sliding.direction_share", effects.friction.direction_share);
  require_none("drive.current_loop_s", effects.drive.current_loop_s);
  require_none("drive.ripple_share", effects.drive.ripple_share);
}

std::size_t sample_count(const ClosedLoopConfig& config) {
  return static_cast<std::size_t>(std::ceil(config.duration_s / config.plant.period_s - 1e-9));
}

/// Requires that `value`, a function of time, is the same at every sample.
template <typename Value>
void require_constant(const ClosedLoopConfig& config, const char* key, const Value& value) {
  const double first = value(0.0);
  for (std::size_t k = 1; k < sample_count(config); ++k) {
    const double time_s = static_cast<double>(k) * config.plant.period_s;
    if (value(time_s) != first)
      throw InputError(
          "physical limit", key, number_text(value(time_s)) + " at " + number_text(time_s) + " s",
          number_text(first) + " throughout is allowed: the limit of a link is known for one step only");
  }
}

PhysicalLimit limit_of_link(const ClosedLoopConfig& config) {
  const LinkLimit best = find_link_limit(link_limit_of_run(config));
  const double setpoint_rad = config.setpoint_rad.at(0.0);
  PhysicalLimit limit;
  limit.counted_pi2 = 0.0;
  for (std::size_t k = 0; k < sample_count(config) && k < best.link_position_rad.size(); ++k) {
    const double error_rad = setpoint_rad - config.plant.initial_position_rad - best.link_position_rad[k];
    const double share = std::abs(error_rad / setpoint_rad);
    limit.pi2 += share;
    if (std::abs(error_rad) > kCountedError_rad) *limit.counted_pi2 += share;
  }
  return limit;
}

}  // namespace

void require_time_optimal_covers(const JointPlantConfig& plant) {
  require_no_effects(plant);
}

LinkLimitConfig link_limit_of_run(const ClosedLoopConfig& config) {
  require_no_effects(config.plant);
  if (config.plant.effects.transmission) {
    const Transmission& gear = *config.plant.effects.transmission;
    require_none("link.coulomb_Nm", gear.link_coulomb_Nm);
    require_none("spring.lost_motion_rad", gear.lost_motion.width_rad);
    require_none("kinematic_error.once_rad", gear.kinematic_error.amplitude_rad[0]);
    require_none("kinematic_error.twice_rad", gear.kinematic_error.amplitude_rad[1]);
    require_none("sliding.transmitted_share", config.plant.effects.friction.transmitted_share);
    require_none("drive.jitter_periods", config.plant.delay.jitter_periods);
  }
  require_constant(config, "reference_rad", [&](double t) { return config.setpoint_rad.at(t); });
  require_constant(config, "load_torque_Nm", [&](double t) { return config.load_torque_Nm.at(t); });
  require_constant(config, "ambient_temperature_C", [&](double t) { return config.ambient.at(t); });
  return link_limit_config(config.plant, config.ambient.at(0.0),
                           config.setpoint_rad.at(0.0) - config.plant.initial_position_rad,
                           config.load_torque_Nm.at(0.0));
}

PhysicalLimit physical_limit(const ClosedLoopConfig& config) {
  if (config.plant.effects.transmission) return limit_of_link(config);
  require_time_optimal_covers(config.plant);
  return {run_time_optimal(config).statistics.pi2, {}};
}

}  // namespace strainwave
