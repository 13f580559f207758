// SPDX-License-Identifier: BSD-3-Clause
// Recognizes messages of another version. LCM begins each with its type's fingerprint, which changes with any field. Not real-time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

/// Whether `bytes` from a channel of `kind` begin with another fingerprint than that of the channel's type. The sender was then built
/// with other types. Returns false for an unknown kind, and for fewer bytes than a fingerprint has.
bool is_of_another_version(std::string_view kind, std::span<const std::uint8_t> bytes);

}  // namespace strainwave
