// SPDX-License-Identifier: BSD-3-Clause
#include "base/input_error.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(InputErrors, QuoteNothingThatCommandsATerminal) {
  EXPECT_STREQ(InputError("a\x1b[2J\u202e\nb").what(), "a?[2J?\nb") << "what we say may have lines";
  EXPECT_STREQ(InputError("data.csv:1", "torque_Nm", "1\n\x9b", "a number").what(),
               "data.csv:1: torque_Nm = 1??: a number")
      << "a value has none";
}

}  // namespace
}  // namespace strainwave
