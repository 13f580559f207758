// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/encoder_side.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(EncoderSide, IsReadFromItsOwnWords) {
  for (const EncoderSide side : {EncoderSide::kMotor, EncoderSide::kLink})
    EXPECT_EQ(encoder_side_from_text(to_text(side)), side);
  EXPECT_EQ(encoder_side_from_text("link"), EncoderSide::kLink);
}

TEST(EncoderSide, IsNotReadFromAnyOtherWord) {
  for (const char* word : {"", "lin", "links", "Motor", "joint"})
    EXPECT_EQ(encoder_side_from_text(word), std::nullopt) << word;
}

}  // namespace
}  // namespace strainwave
