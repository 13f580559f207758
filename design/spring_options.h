// SPDX-License-Identifier: BSD-3-Clause
// The box of joints with a spring that verify and gains are given on the command line. Offline.
#pragma once

#include <optional>
#include <string>

#include "design/gains/spring_proof.h"

namespace CLI {
class App;
}

namespace strainwave {

struct SpringOptions {
  std::optional<double> motor_inertia_kgm2;
  /// "FROM..TO" or one number, in kg m^2 or "kg@RADIUSm"; empty: no spring is meant
  std::string load_inertia_kgm2;
  std::string damping_Nms_rad = "0";
  std::string delay_periods = "1";

  bool given() const { return !load_inertia_kgm2.empty(); }
};

/// --motor-inertia_kgm2, --load-inertia_kgm2 alias --load, --damping_Nms_rad, --delay.
void add_spring_options(CLI::App& command, SpringOptions& options);

/// What of a box the options say; stiffness and friction are the gear's and the table's. Throws InputError naming `place`.
struct SpringRequest {
  double motor_inertia_kgm2 = 0.0;
  BoxRange link_inertia_kgm2;
  BoxRange damping_Nms_rad;
  int least_delay = 0;
  int most_delay = 0;
};
SpringRequest spring_request(const SpringOptions& options, const std::string& place,
                             double motor_inertia_kgm2);

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
