// SPDX-License-Identifier: BSD-3-Clause
#include "design/table_report.h"

#include <gtest/gtest.h>

#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

GainTable reference_table() {
  return read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
}

TEST(TableReport, MarksThePairThatFails) {
  GainTable table = reference_table();
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
  const std::string text = description(reference_table());
  for (const char* const part :
       {"rhs17-6006", "0.089 kg m^2", "zero velocity", "high velocity, T5", "fallback: C3", "[Nm/rad]"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

}  // namespace
}  // namespace strainwave
