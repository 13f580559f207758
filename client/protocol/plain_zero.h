// SPDX-License-Identifier: BSD-3-Clause
// Turns a negative zero into a plain zero, for people and for comparisons. Other numbers and NaN stay.
#pragma once

#include <type_traits>

namespace strainwave {

template <typename Number>
constexpr Number plain_zero(Number value) noexcept {
  if constexpr (std::is_floating_point_v<Number>) return value + Number{0};
  return value;
}

}  // namespace strainwave
