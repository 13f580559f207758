// SPDX-License-Identifier: BSD-3-Clause
#include "design/table_report.h"

#include <gtest/gtest.h>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

TEST(TableReport, MarksThePairThatFails) {
  GainTable table = testing::shipped_table("rhs17-6006");
  const CertificateReport good = certify(table.primary, table.plant, table.friction);
  const std::string text = margins_text(table.primary, good);
  EXPECT_NE(text.find("C4: certified"), std::string::npos);
  EXPECT_EQ(text.find('!'), std::string::npos);
  for (double& gain : table.primary.F[1]) gain = -gain;
  const std::string bad = margins_text(table.primary, certify(table.primary, table.plant, table.friction));
  EXPECT_NE(bad.find("NOT CERTIFIED"), std::string::npos);
  EXPECT_NE(bad.find('!'), std::string::npos);
}

TEST(TableReport, DescribesEveryRuleWithUnits) {
  const std::string text = description(testing::shipped_table("rhs17-6006"));
  for (const char* const part :
       {"rhs17-6006", "0.089 kg m^2", "zero velocity", "high velocity, T5", "fallback: C3", "[Nm/rad]"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace strainwave
