// SPDX-License-Identifier: BSD-3-Clause
#include "commission/identification.h"

#include <gtest/gtest.h>

#include "tests/commission/random_joints.h"

namespace strainwave::testing {
namespace {}
}  // namespace strainwave::testing
