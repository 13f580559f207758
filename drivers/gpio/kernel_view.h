// SPDX-License-Identifier: BSD-3-Clause
// Levels of lines that another process holds, from the kernel's debugfs list (root only); such lines cannot
// be requested. Not real-time. Source: gpiolib_dbg_show() of the kernel. The format is not guaranteed, so
// unexpected text gives no result.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strainwave {

/// Returns whether line `offset` of `chip` ("gpiochip0") is high, from the text of /sys/kernel/debug/gpio.
std::optional<bool> level_in_kernel_list(std::string_view text, std::string_view chip, unsigned offset);

/// The same from the file itself; nothing when it cannot be read.
std::optional<bool> level_of_held_line(std::string_view chip, unsigned offset);

}  // namespace strainwave
