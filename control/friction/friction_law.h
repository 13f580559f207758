// SPDX-License-Identifier: BSD-3-Clause
// Friction over temperature and speed. Joint side, SI.
#pragma once

#include "control/friction/friction.h"

namespace strainwave {

struct FrictionLaw {
  ExponentialTemperatureLaw over_temperature;
  StribeckShape stribeck;
};

}  // namespace strainwave
