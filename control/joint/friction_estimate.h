// SPDX-License-Identifier: BSD-3-Clause
// Friction of a gear by its size, from the one whose friction over temperature is known: the RHS-17-6006, size 17 and ratio 50
// (data/friction_parameters.csv). An estimate: expect half to twice. Offline.
//
//   b = Ts / Ts17                          factor of static and Coulomb friction, motor side
//   v = (Tr - b Tc17) / (Tv17 2000 RPM)    factor of viscous friction, motor side
//
// Ts and Tr are starting and running torque at 20 degC (data/gears.csv). Ts17, Tc17 and Tv17 are static, Coulomb and viscous friction of the
// RHS-17-6006 there. Without a torque in the file the factor is (size / 17)^3, by which running torques grow within 20 %. The trend over
// temperature is that of the RHS-17-6006 and of its grease, SK-2.
#pragma once

#include "control/friction/friction.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

/// Friction of `gear` at the joint where that of the RHS-17-6006, at its joint, is `rhs17`. Linear in `rhs17`: also for the parts of a law.
FrictionParameters estimate_friction(const Gear& gear, const FrictionParameters& rhs17);

/// The same of a law.
FrictionLaw estimate_friction(const Gear& gear, FrictionLaw rhs17);

}  // namespace strainwave
