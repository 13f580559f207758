// SPDX-License-Identifier: BSD-3-Clause
// Estimates the friction of a gear from its size and its catalogue torques. The reference is the RHS-17-6006, size 17 and ratio 50, whose
// friction over temperature is known (data/friction_parameters.csv). Expect half to twice the estimate. Offline.
//
//   b = Ts / Ts17                          factor of static and Coulomb friction, motor side
//   v = (Tr - b Tc17) / (Tv17 2000 RPM)    factor of viscous friction, motor side
//
// Ts and Tr are starting and running torque at 20 degC (data/gears.csv). Ts17, Tc17 and Tv17 are static, Coulomb and viscous friction of
// the RHS-17-6006 at 20 degC. If the file lacks a torque, the factor is (size / 17)^3, from which running torques differ by up to 20 %. The
// trend over temperature is that of the RHS-17-6006 and of its grease, SK-2.
#pragma once

#include "control/friction/friction.h"
#include "control/joint/gear_catalogue.h"

namespace strainwave {

/// Joint friction of `gear`, if the RHS-17-6006 has `rhs17` at its joint. Linear in `rhs17`, so that the parts of a law may be passed.
FrictionParameters estimate_friction(const Gear& gear, const FrictionParameters& rhs17);

/// The same for a law over temperature and speed.
FrictionLaw estimate_friction(const Gear& gear, FrictionLaw rhs17);

}  // namespace strainwave
