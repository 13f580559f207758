// SPDX-License-Identifier: BSD-3-Clause
// A text that is made once and sent to several connections. Not real-time.
#pragma once

#include <memory>
#include <string>
#include <utility>

namespace strainwave {

using SharedText = std::shared_ptr<const std::string>;

inline SharedText shared_text(std::string text) {
  return std::make_shared<const std::string>(std::move(text));
}

}  // namespace strainwave
