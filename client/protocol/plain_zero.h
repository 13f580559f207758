// SPDX-License-Identifier: BSD-3-Clause
// Of a negative zero a plain one: what a person reads or another program compares. Any other number, and no number, stays.
#pragma once

#include <type_traits>

namespace strainwave {

template <typename Number>
constexpr Number plain_zero(Number value) noexcept {
  if constexpr (std::is_floating_point_v<Number>) return value + Number{0};
  return value;
}

}  // namespace strainwave
