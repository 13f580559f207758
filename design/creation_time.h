// SPDX-License-Identifier: BSD-3-Clause
// When a table is made. Offline.
#pragma once

#include <string>

namespace strainwave {

/// Now in ISO 8601, or the time of SOURCE_DATE_EPOCH for reproducible files. Throws InputError where that is no time.
std::string utc_now();

}  // namespace strainwave
