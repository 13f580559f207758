// On which side of the gear's spring a joint's position is measured. On a rigid joint both are the same. Real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

enum class EncoderSide : std::int32_t { kMotor = 0, kLink = 1 };

/// "motor" or "link".
constexpr const char* to_text(EncoderSide side) noexcept {
  return side == EncoderSide::kLink ? "link" : "motor";
}

}  // namespace strainwave
