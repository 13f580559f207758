// SPDX-License-Identifier: BSD-3-Clause
// The creation time of a table. Offline.
#pragma once

#include <string>

namespace strainwave {

/// Now in ISO 8601, or the time of SOURCE_DATE_EPOCH for reproducible files. Throws InputError if that is not a time.
std::string utc_now();

}  // namespace strainwave
