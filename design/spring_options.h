// SPDX-License-Identifier: BSD-3-Clause
// Options of verify and gains for a box of joints with a spring. Offline.
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
  /// "FROM..TO" or one number, in kg m^2 or "MASSkg@RADIUSm"; empty: no spring
  std::string load_inertia_kgm2;
  std::string stiffness_Nm_rad;  ///< first slope, "FROM..TO" or one number; empty: the gear's
  std::string damping_Nms_rad = "0";
  std::string delay_periods = "1";

  bool given() const { return !load_inertia_kgm2.empty(); }
};

/// Adds --motor-inertia_kgm2, --load-inertia_kgm2 alias --load, --stiffness_Nm_rad, --damping_Nms_rad, --delay.
void add_spring_options(CLI::App& command, SpringOptions& options);

/// The given range, or one number as both ends; nothing if it is not given. Throws InputError naming `place`.
std::optional<BoxRange> given_motor_inertia(const SpringOptions& options, const std::string& place);

/// The box that the options describe. Throws InputError naming `place`.
SpringRequest spring_request(const SpringOptions& options, const std::string& place,
                             const BoxRange& motor_inertia_kgm2);

}  // namespace strainwave
