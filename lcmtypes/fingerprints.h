// SPDX-License-Identifier: BSD-3-Clause
// Messages of another version: LCM begins each with its type's fingerprint, which changes with any field. Not real-time.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace strainwave {

/// Whether `bytes` from a channel of `kind` begin with another fingerprint than that of the type which travels there: a program that
/// was built with other types speaks. False for a kind that is none of ours, and for less than a fingerprint.
bool is_of_another_version(std::string_view kind, std::span<const std::uint8_t> bytes);

}  // namespace strainwave
