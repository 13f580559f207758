// SPDX-License-Identifier: BSD-3-Clause
#include "design/table_report.h"

#include <gtest/gtest.h>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

TEST(TableReport, DescribesEveryRuleWithUnits) {
  const std::string text = description(testing::shipped_table("rhs17-6006"));
  for (const char* const part :
       {"rhs17-6006", "0.089 kg m^2", "zero velocity", "high velocity, T5", "fallback: C3", "[Nm/rad]"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace strainwave
