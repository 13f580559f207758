// SPDX-License-Identifier: BSD-3-Clause
// The box of joints with a spring that verify and gains are given on the command line. Offline.
#pragma once

#include <optional>
#include <string>

#include "design/gains/spring_verdict.h"

namespace CLI {
class App;
}

namespace strainwave {

struct SpringOptions {
  std::string motor_inertia_kgm2;  ///< "FROM..TO" or one number; empty: the catalogue's
  /// "FROM..TO" or one number, in kg m^2 or "kg@RADIUSm"; empty: no spring is meant
  std::string load_inertia_kgm2;
  std::string stiffness_Nm_rad;  ///< the first slope, likewise; empty: the gear's
  std::string damping_Nms_rad = "0";
  std::string delay_periods = "1";

  bool given() const { return !load_inertia_kgm2.empty(); }
};

/// --motor-inertia_kgm2, --load-inertia_kgm2 alias --load, --stiffness_Nm_rad, --damping_Nms_rad, --delay.
void add_spring_options(CLI::App& command, SpringOptions& options);

/// As given, from and to the same for one number; nothing if it is not. Throws InputError naming `place`.
std::optional<BoxRange> given_motor_inertia(const SpringOptions& options, const std::string& place);

/// Throws InputError naming `place`.
SpringRequest spring_request(const SpringOptions& options, const std::string& place,
                             const BoxRange& motor_inertia_kgm2);

}  // namespace strainwave
