// Recorded states as CSV: the first column names the joint, the others are the message's fields under their
// own names (an array as name_0, name_1, ...). Numbers read back to the same bits. Not real-time.
#pragma once

#include <strainwave/state_v1.hpp>
#include <string>

namespace strainwave {

/// Both without the line's end.
std::string csv_header();
std::string csv_row(const std::string& joint, const state_v1& state);

}  // namespace strainwave
