// SPDX-License-Identifier: BSD-3-Clause
// The reference case of docs/theory.md, section 7: the source's joint with the rules of its Table 5.
#pragma once

#include "design/friction/friction_file.h"
#include "design/gains/controller_design.h"

namespace strainwave {

inline DesignRequest reference_request() {
  DesignRequest request;
  request.plant.joint_model = std::string_view("rhs17-6006");
  request.plant.inertia_kgm2 = 0.089;
  request.plant.gear_ratio = 50.0;
  request.plant.period_s = 1e-3;
  request.friction =
      read_friction_rules(STRAINWAVE_SOURCE_DIR "/data/fuzzy_rules_table5.csv", 50.0, GearSide::kJoint)
          .friction;
  request.weights = {0.1, 1.0, 1e-4, 1e-6};
  request.initial_states = {StateVector(0.0, 1.0, 0.0)};
  return request;
}

inline constexpr std::array<Controller, 4> kAllControllers{Controller::kC1, Controller::kC2, Controller::kC3,
                                                           Controller::kC4};

}  // namespace strainwave
