// SPDX-License-Identifier: BSD-3-Clause
// `strainwaved --check`: checks whether the daemon would start on this machine with a configuration. Loads and certifies every file
// that the start would, and lists the checks that it omits. Touches no drive, takes no lock, changes nothing. Not real-time.
#pragma once

#include <ostream>

#include "daemon/config/config.h"

namespace strainwave {

/// Writes to `out` the warnings about `config`, the verdict on each joint's table, its load limits, and the omitted checks. Throws
/// InputError for an error that would end the start: a table that is missing, not protected or not certified; no gateway. Multicast
/// that does not work now is only a warning.
void check_start(const DaemonConfig& config, std::ostream& out);

}  // namespace strainwave
