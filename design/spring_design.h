// SPDX-License-Identifier: BSD-3-Clause
// Gains whose box is certified: for a rigid joint those that are asked for, for a gear that is a spring the most aggressive of a family.
// Offline.
#pragma once

#include <functional>
#include <string>

#include "design/gains/controller_design.h"
#include "design/spring_options.h"

namespace strainwave {

struct SpringDesign {
  GainTable table;   ///< with its box
  std::string text;  ///< the weight that was found and what proves it, in lines
};

/// design_table(), with its box unless the sampling is forward Euler. Throws NotAchieved where it is not certified, with the weights of
/// softer gains that are.
GainTable design_rigid(Controller controller, const TableRequest& request);

/// What is tried now, in words.
using DesignProgress = std::function<void(const std::string&)>;

/// Of gains over the torque's weight, from that of `request` to 1e-5, the first that are certified, to a quarter of a decade; on the motor's
/// encoder with a lead where they are not without. A motor inertia of one number is certified within 5 % of it, or as far as gains are found.
/// Throws InputError where no table can hold what is asked for. Throws NotAchieved
/// with the last refusal where no gains are certified, and with a narrower range of links for which some are, if one was found.
SpringDesign design_on_spring(Controller controller, const TableRequest& request, const std::string& gear,
                              const SpringRequest& spring, const DesignProgress& progress);

}  // namespace strainwave
