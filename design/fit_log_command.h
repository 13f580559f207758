// SPDX-License-Identifier: BSD-3-Clause
// `strainwave-design fit --log` merges friction measured on a joint with the catalogue's. Offline.
#pragma once

#include <string>
#include <vector>

#include "design/friction/friction_update.h"
#include "strainwave/exit_status.h"

namespace strainwave {

struct FitLogOptions {
  std::vector<std::string> logs;
  std::string prior;  ///< friction file of a catalogue fit
  std::string joint;  ///< empty: the only joint of each log
  std::string out;
  UpdateWeights weights;
  double confidence = 0.95;
  double wanted = 0.05;  ///< relative half width above which a temperature counts as missing
};

/// Returns the exit status. Throws InputError.
ExitStatus fit_logs(const FitLogOptions& options);

}  // namespace strainwave
