// SPDX-License-Identifier: BSD-3-Clause
// `strainwaved --check`: whether the daemon would start on this machine with a configuration. Loads and certifies all that the
// start would, and says what it leaves to others. Touches no drive, takes no lock, changes nothing. Not real-time.
#pragma once

#include <ostream>

#include "daemon/config/config.h"

namespace strainwave {

/// Writes to `out` the doubts about `config`, what holds for each joint's table, and what was not checked. Throws InputError for
/// what would end the start: a table that is not there, not protected or not certified; no gateway. Multicast that does not work
/// now is a doubt.
void check_start(const DaemonConfig& config, std::ostream& out);

}  // namespace strainwave
