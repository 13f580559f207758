// SPDX-License-Identifier: BSD-3-Clause
// Whether the gains of a table are proved on a box of joints, delay by delay. Offline.
#pragma once

#include <optional>
#include <string>

#include "design/gains/spring_proof.h"

namespace strainwave {

/// What a user says of a box; its friction is the table's.
struct SpringRequest {
  BoxRange motor_inertia_kgm2;
  BoxRange link_inertia_kgm2;
  std::optional<BoxRange>
      stiffness_1_Nm_rad;  ///< of the first slope, by which the gear's others grow, too; nothing: the gear's
  BoxRange damping_Nms_rad;
  int least_delay = 0;
  int most_delay = 0;
};

/// One line per delay, each of which has its own proof: a joint has one.
struct SpringVerdict {
  bool certified = true;
  std::string text;
  CertifiedBox box;  ///< for the table, where all are certified
};
SpringVerdict judge_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request);

/// The same for a table that is to be written: at most kMaxBoxCells cells and kMaxBoxDelay periods, and no delay after the
/// first without a proof.
SpringVerdict box_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request);

/// The box of a rigid joint with the table's inertia, at every delay from 0 to kMaxBoxDelay periods.
SpringVerdict box_of_rigid(const GainTable& table);

}  // namespace strainwave
