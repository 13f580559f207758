// SPDX-License-Identifier: BSD-3-Clause
// Proves the gains of a table on a box of joints, delay by delay. Offline.
#pragma once

#include <optional>
#include <string>

#include "design/gains/spring_proof.h"

namespace strainwave {

/// A user's description of a box. The friction is the table's.
struct SpringRequest {
  BoxRange motor_inertia_kgm2;
  BoxRange link_inertia_kgm2;
  std::optional<BoxRange> stiffness_1_Nm_rad;  ///< first slope, others in proportion; none: the gear's
  BoxRange damping_Nms_rad;
  int least_delay = 0;
  int most_delay = 0;
};

/// The result, with one line of text per delay. Each delay has its own proof, because the delay of a joint is constant.
struct SpringVerdict {
  bool certified = true;
  std::string text;
  CertifiedBox box;  ///< the table's box, if all delays are certified
};
SpringVerdict judge_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request);

/// The same for a table to be written: at most kMaxBoxCells cells and kMaxBoxDelay periods. Stops at the
/// first delay without a proof.
SpringVerdict box_on_spring(const GainTable& table, const std::string& gear, const SpringRequest& request);

/// The box of a rigid joint with the table's inertia, at every delay from 0 to kMaxBoxDelay periods.
SpringVerdict box_of_rigid(const GainTable& table);

}  // namespace strainwave
