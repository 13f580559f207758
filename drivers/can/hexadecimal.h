// SPDX-License-Identifier: BSD-3-Clause
// Hexadecimal numbers in the notation of CANopen documents: 6041h. Not real-time.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <string>

namespace strainwave {

inline std::string hexadecimal(std::uint64_t value, int digits) {
  std::array<char, 24> text{};
  std::snprintf(text.data(), text.size(), "%0*llXh", digits, static_cast<unsigned long long>(value));
  return text.data();
}

}  // namespace strainwave
