// SPDX-License-Identifier: BSD-3-Clause
// Text in a plain struct: at most N-1 bytes, zero padded, so that the struct can be copied as bytes.
// Real-time safe.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace strainwave {

template <std::size_t N>
struct FixedString {
  std::array<char, N> bytes{};

  FixedString() = default;
  /// Keeps the first N-1 bytes of `text`.
  FixedString(std::string_view text) {  // NOLINT(google-explicit-constructor): reads as an assignment of text
    std::copy_n(text.begin(), std::min(text.size(), N - 1), bytes.begin());
  }
  /// The text up to the first zero byte; never reads past the array.
  std::string_view view() const noexcept {
    return {bytes.data(),
            static_cast<std::size_t>(std::find(bytes.begin(), bytes.end(), '\0') - bytes.begin())};
  }
  bool is_printable() const noexcept {
    return std::ranges::all_of(view(), [](char c) { return c >= ' ' && c <= '~'; });
  }
  bool operator==(const FixedString&) const = default;
};

}  // namespace strainwave
