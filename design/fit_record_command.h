// SPDX-License-Identifier: BSD-3-Clause
// `strainwave-design fit --record` estimates the friction of a commissioned joint. Measurements at one temperature
// correct the catalogue's friction of its gear at all temperatures (design/friction/friction_update.h). Offline.
#pragma once

#include <string>

#include "strainwave/exit_status.h"

namespace strainwave {

struct FitRecordOptions {
  std::string record;       ///< commission.json
  std::string gear;         ///< by its catalogue name
  std::string joint_model;  ///< empty: the gear's usual one
  std::string out;
};

/// Returns the exit status. Throws InputError.
ExitStatus fit_record(const FitRecordOptions& options);

}  // namespace strainwave
