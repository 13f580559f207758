// SPDX-License-Identifier: BSD-3-Clause
// The cost of a wrong spring, load, friction or delay in the model of the daemon's controller. Each joint runs with the right model
// and with wrong ones. Offline; uses all cores; the result does not depend on their number. Source: docs/flexible-joint.md.
#pragma once

#include <vector>

#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

struct WronglyConfiguredRow {
  FlexibleCell cell;
  FlexibleResult result;    ///< judged without a limit
  double over_known = 1.0;  ///< link's sum |e / r| above 40 urad over that with the right model
};

/// Runs `contender` on every cell. A cell of effect "none" is the baseline of the cells after it, up to the next one.
std::vector<WronglyConfiguredRow> run_wrongly_configured(const std::vector<FlexibleCell>& cells,
                                                         const Contender& contender);

/// One row per wrong quantity in the model, in the order of the cells.
TextTable wrongly_configured_summary(const std::string& title, const std::vector<WronglyConfiguredRow>& rows);

}  // namespace strainwave
