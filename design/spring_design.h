// SPDX-License-Identifier: BSD-3-Clause
// Designs gains whose box is certified. For a rigid joint these are the requested gains. For a gear with a
// spring they are the most aggressive of a family. Offline.
#pragma once

#include <functional>
#include <string>

#include "design/gains/controller_design.h"
#include "design/spring_options.h"

namespace strainwave {

struct SpringDesign {
  GainTable table;   ///< with its box
  std::string text;  ///< lines with the weight that was found and its proof
};

/// design_table() with a certified box, or without a box if the sampling is forward Euler. Throws NotAchieved
/// if the box is not certified. The message names the weights of softer gains that are certified, if any.
GainTable design_rigid(Controller controller, const TableRequest& request);

/// Receives a description of each attempt.
using DesignProgress = std::function<void(const std::string&)>;

/// Raises the torque's weight from that of `request` to 1e-5, more for a light joint. Returns the first gains that are certified, to a
/// quarter of a decade. With the encoder on the motor, it adds a lead if they are not certified without one. A motor inertia of one
/// number is certified within 5 % of it, else within 2 %. Throws InputError if no table can hold the request. Throws NotAchieved with
/// the last refusal if no gains are certified. The message names a narrower range of links if gains for one are certified.
SpringDesign design_on_spring(Controller controller, const TableRequest& request, const std::string& gear,
                              const SpringRequest& spring, const DesignProgress& progress);

}  // namespace strainwave
