// SPDX-License-Identifier: BSD-3-Clause
// The gain table as JSON: one key per field, named as in gain_table.h; matrices as arrays of rows. Reading checks the structure of a
// table: counts, finite numbers, signs and ranges of every field. Not real-time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "control/table/gain_table.h"

namespace strainwave {

/// The first defect of a table that did not come as JSON, in words (key, value, what is allowed), or nothing. box_certificate.h proves
/// whether the gains stabilise the plant.
std::optional<std::string> find_defect(const GainTable& table);

/// Throws InputError that begins with `source` if a table with this torque limit must not have these rules.
void require_friction(const FuzzyFriction& friction, double torque_limit_Nm, const std::string& source);

/// Pretty-printed JSON that reads back to the same bits. Throws InputError if the table has a defect.
std::string to_json(const GainTable& table);

/// Reads what to_json wrote. Throws InputError naming `source`, the key, the value and what is allowed:
/// malformed JSON, unknown, missing or repeated keys, wrong types and sizes, another format, and every defect.
GainTable gain_table_from_json(std::string_view text, const std::string& source);

/// The same from and to a file. Writing replaces the file only once the new text is complete.
GainTable read_gain_table(const std::filesystem::path& path);
void write_gain_table(const GainTable& table, const std::filesystem::path& path);

}  // namespace strainwave
