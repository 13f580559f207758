// SPDX-License-Identifier: BSD-3-Clause
// Levels of lines that a process holds, as the kernel's own list shows them (debugfs, for root only); others
// cannot request them. Not real-time. Source: gpiolib_dbg_show() of the kernel; its format is not promised, so what
// does not look as expected is nothing.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace strainwave {

/// Whether line `offset` of `chip` ("gpiochip0") is high, by the text of /sys/kernel/debug/gpio.
std::optional<bool> level_in_kernel_list(std::string_view text, std::string_view chip, unsigned offset);

/// The same by the file itself; nothing when it cannot be read.
std::optional<bool> level_of_held_line(std::string_view chip, unsigned offset);

}  // namespace strainwave
