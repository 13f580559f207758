// SPDX-License-Identifier: BSD-3-Clause
// Text in and out: positions as people type them, states as lines for a terminal. No network, no clock. Not real-time.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "client/protocol/client.h"
#include "client/protocol/state_view.h"

namespace strainwave {

/// A daemon publishes at least this often at any sensible rate.
inline constexpr double kStateSilence_s = 1.0;

/// A position in rad: a plain finite decimal number and nothing else. Throws ClientError (usage) that names
/// what was typed; for an angle with a degree mark it says the same angle in rad.
double parse_position_rad(std::string_view text);

/// At most `columns` characters of `line`; bytes of UTF-8 continuation count for nothing.
std::string clipped(std::string_view line, std::size_t columns);

/// `text` in lines of at most `columns`, broken at blanks where there are some; of more than `most` lines the last ends in "...".
std::vector<std::string> wrapped(std::string_view text, std::size_t columns, std::size_t most);

/// "elbow", or "SW.elbow" when `names` has joints of several daemons.
std::string display_name(const JointName& name, const std::vector<JointName>& names);

/// `value` for printing with so many decimals: what they show nothing of is a plain 0, so that no "-0.0" is read.
double without_negative_zero(double value, int decimals) noexcept;

/// "+21.5", or "-" as long as no temperature is known: temperature_status tells why.
std::string temperature_text(double temperature_C);

/// Of a column in which the names of all of them stand.
std::size_t name_columns(const std::vector<JointName>& names);

/// Column titles of state_row().
std::string state_header(std::size_t name_columns);

/// One joint in one line of a terminal of 80 columns: what is wanted, what is; and its notes, if it has any, in lines below it.
/// `age_s`: since the state was received.
std::string state_row(const std::string& joint, std::size_t name_columns, const JointView& view,
                      double age_s);

/// What an operator should know beyond the numbers: fault, limits in force, silence, two daemons; empty when
/// all is well.
std::string state_notes(const JointView& view, double age_s);

/// Every field of the state with its meaning, one per line.
std::string state_details(const std::string& joint, const JointView& view, double age_s);

}  // namespace strainwave
