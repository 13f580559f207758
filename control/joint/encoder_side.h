// SPDX-License-Identifier: BSD-3-Clause
// On which side of the gear's spring a joint's position is measured. On a rigid joint both are the same. Real-time safe.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace strainwave {

enum class EncoderSide : std::int32_t { kMotor = 0, kLink = 1 };

/// "motor" or "link".
constexpr const char* to_text(EncoderSide side) noexcept {
  return side == EncoderSide::kLink ? "link" : "motor";
}

/// The side with this name, or nothing.
constexpr std::optional<EncoderSide> encoder_side_from_text(std::string_view text) noexcept {
  for (const EncoderSide side : {EncoderSide::kMotor, EncoderSide::kLink})
    if (text == to_text(side)) return side;
  return std::nullopt;
}

}  // namespace strainwave
