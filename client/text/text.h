// SPDX-License-Identifier: BSD-3-Clause
// Text input and output: positions as people type them, states as lines for a terminal. No network, no clock. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/state_view.h"

namespace strainwave {

/// A joint counts as silent after this time. At any sensible rate, a daemon publishes more often.
inline constexpr double kStateSilence_s = 1.0;

/// Parses a position in rad: one finite decimal number without a unit. Throws ClientError (usage) that quotes
/// the input. For an angle with a degree mark it gives the same angle in rad.
double parse_position_rad(std::string_view text);

/// The first `columns` characters of `line`. UTF-8 continuation bytes do not count.
std::string clipped(std::string_view line, std::size_t columns);

/// `text` in lines of at most `columns`, broken at spaces if possible. With more than `most` lines, the last one ends in "...".
std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t most);

/// "elbow", or "SW.elbow" when `names` has joints of several daemons.
std::string display_name(const JointName& name, const std::vector<JointName>& names);

/// `value` for printing with this number of decimals: 0 if it would print as zero, so that no "-0.0" appears.
double without_negative_zero(double value, int decimals) noexcept;

/// "+21.5", or "-" while the temperature is unknown. temperature_status gives the reason.
std::string temperature_text(double temperature_C);

/// Width of a column that holds all of the names.
std::size_t name_columns(const std::vector<JointName>& names);

/// Column titles of state_row().
std::string state_header(std::size_t name_columns);

/// One joint in one line of 80 columns: setpoint and measurement. Its notes, if any, follow in lines below.
/// `age_s`: time since the state was received.
std::string state_row(const std::string& joint, std::size_t name_columns, const JointView& view,
                      double age_s);

/// Notes for an operator, in addition to the numbers: fault, active limits, silence, two daemons. Empty when
/// all is well.
std::string state_notes(const JointView& view, double age_s);

/// Every field of the state with its meaning, one per line.
std::string state_details(const std::string& joint, const JointView& view, double age_s);

}  // namespace strainwave
