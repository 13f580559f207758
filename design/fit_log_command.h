// SPDX-License-Identifier: BSD-3-Clause
// strainwave-design fit --log: friction measured on a joint, merged with the catalogue's. Offline.
#pragma once

#include <string>
#include <vector>

#include "design/friction/friction_update.h"
#include "strainwave/exit_status.h"

namespace strainwave {

struct FitLogOptions {
  std::vector<std::string> logs;
  std::string prior;  ///< friction file of a catalogue fit
  std::string joint;  ///< empty: the only one of each log
  std::string out;
  UpdateWeights weights;
  double confidence = 0.95;
  double wanted =
      0.05;  ///< half width of the interval, relative, above which a temperature counts as missing
};

/// The exit status; throws InputError.
ExitStatus fit_logs(const FitLogOptions& options);

}  // namespace strainwave
