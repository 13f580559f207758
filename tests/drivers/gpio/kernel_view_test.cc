// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/kernel_view.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

// Linux 6.1 numbers lines over all chips.
constexpr std::string_view kNumbered =
    "gpiochip1: GPIOs 500-511, parent: platform/gpio-sim.0, joint-board:\n"
    " gpio-500 (enable              |strainwaved elbow   ) out hi \n"
    " gpio-505 (estop (2nd contact) |strainwaved elbow   ) in  lo IRQ ACTIVE LOW\n"
    "\n"
    "gpiochip0: GPIOs 512-523, parent: platform/x, other:\n"
    " gpio-512 (                    |sysfs               ) out lo \n";
// Newer kernels number lines per chip.
constexpr std::string_view kByChip =
    "gpiochip0: 12 GPIOs, parent: platform/gpio-sim.0, joint-board:\n"
    " gpio-0   (enable              |strainwaved elbow   ) out lo \n"
    " gpio-10  (index               |strainwaved elbow   ) in  hi \n";

TEST(KernelView, FindsTheLevelOfALineWhateverItsNumbering) {
  EXPECT_EQ(level_in_kernel_list(kNumbered, "gpiochip1", 0), true);
  EXPECT_EQ(level_in_kernel_list(kNumbered, "gpiochip1", 5), false);
  EXPECT_EQ(level_in_kernel_list(kNumbered, "gpiochip0", 0), false);
  EXPECT_EQ(level_in_kernel_list(kByChip, "gpiochip0", 0), false);
  EXPECT_EQ(level_in_kernel_list(kByChip, "gpiochip0", 10), true);
}

TEST(KernelView, SaysNothingOfWhatItDoesNotKnow) {
  EXPECT_FALSE(level_in_kernel_list(kNumbered, "gpiochip1", 1));
  EXPECT_FALSE(level_in_kernel_list(kNumbered, "gpiochip", 0));
  EXPECT_FALSE(level_in_kernel_list(kByChip, "gpiochip0", 1));
  EXPECT_FALSE(level_in_kernel_list("", "gpiochip0", 0));
  EXPECT_FALSE(level_in_kernel_list("gpiochip0: 1 GPIOs\n gpio-0 (a|b", "gpiochip0", 0));
}

}  // namespace
}  // namespace strainwave
