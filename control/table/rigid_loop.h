// SPDX-License-Identifier: BSD-3-Clause
// The loop that the daemon closes around a rigid joint, with the delay that the certificate of its gains (certificate.h) leaves out. No proof: an
// eigenvalue above 1 says that gains which are certified without delay make a limit cycle with it. Not real-time. Joint side, SI.
//
//   x  = [ integral, e, w, z, u one period ago, ..., u d periods ago ]
//   u  = F_0 integral + F_1 e + F_2 (e - z) / h          z: the last reading
//   e, w: bounded_dynamics() of ts_plant.h with u of d periods ago
#pragma once

#include <optional>
#include <string>

#include "control/table/gain_table.h"

namespace strainwave {

/// The largest eigenvalue in magnitude. `delay_periods` in 0..9; without an integrator that state is left out.
double rigid_loop_radius(const PlantIdentity& plant, double viscous_Nms_rad, const GainRow& gain,
                         bool has_integrator, int delay_periods);

/// The gains and delay of `table`, of any delay from `least_delay` to `most_delay`, with which a rigid joint swings up, in words with
/// what to do; or nothing.
std::optional<std::string> find_swing(const GainTable& table, int least_delay, int most_delay);

}  // namespace strainwave
