// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/message_csv.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

TEST(MessageCsv, QuotesTextSoThatItStaysOneCell) {
  ack_v1 ack{};
  const std::string hostile = "a \"quote\", a comma\nand a line";
  std::copy(hostile.begin(), hostile.end(), ack.text);
  EXPECT_TRUE(csv_values(ack).ends_with(",\"a \"\"quote\"\", a comma?and a line\"")) << csv_values(ack);
}

TEST(MessageCsv, HasAColumnForEveryEntryOfAnArray) {
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  EXPECT_EQ(commas(csv_columns<timing_v1>()), 12 + 4 * 64 + kReasonCount);
  EXPECT_EQ(commas(csv_values(timing_v1{})), 12 + 4 * 64 + kReasonCount);
}

}  // namespace
}  // namespace strainwave
