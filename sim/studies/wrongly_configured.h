// SPDX-License-Identifier: BSD-3-Clause
// What a wrong spring, load, friction or delay in its model costs the daemon's controller: the same joint twice, once with the right
// model. Offline; uses all cores; the result does not depend on how many. Source: docs/flexible-joint.md.
#pragma once

#include <vector>

#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

struct WronglyConfiguredRow {
  FlexibleCell cell;
  FlexibleResult result;  ///< without a limit
  double over_known =
      1.0;  ///< the link's sum |e / r| above 40 urad over that of the same joint, configured as it is
};

/// Runs `contender` on every cell. A cell of effect "none" is what those after it are compared with, up to the next.
std::vector<WronglyConfiguredRow> run_wrongly_configured(const std::vector<FlexibleCell>& cells,
                                                         const Contender& contender);

/// A row for each thing that is wrong in the model, in the order of the cells.
TextTable wrongly_configured_summary(const std::string& title, const std::vector<WronglyConfiguredRow>& rows);

}  // namespace strainwave
