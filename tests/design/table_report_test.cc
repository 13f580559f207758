// SPDX-License-Identifier: BSD-3-Clause
#include "design/table_report.h"

#include <gtest/gtest.h>

#include "tests/support/reference_joint.h"

namespace strainwave {
namespace {

TEST(TableReport, DescribesEveryRuleWithUnits) {
  const std::string text = description(testing::shipped_table("rhs17-6006"));
  for (const char* const part :
       {"rhs17-6006", "0.089 kg m^2", "zero velocity", "high velocity, T5", "gains: C4", "[Nm/rad]"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part;
  }
}

TEST(TableReport, NamesTheLinksWhoseStiffnessMayChangeAtAnyInstant) {
  CertifiedBox box = testing::shipped_table("csf-17-50-delays").box;
  EXPECT_NE(stiffness_text(box).find("at any instant with links of 0.0783..0.3 kg m2, with lighter ones"),
            std::string::npos)
      << stiffness_text(box);
  const std::string wider_motor = stiffness_text(testing::shipped_table("csf-17-50").box);
  EXPECT_NE(wider_motor.find("at any instant with links of 0.1225..0.3 kg m2"), std::string::npos)
      << wider_motor;
  for (BoxCell& cell : box.cells) cell.stiffness_Nm_rad = box.stiffness_Nm_rad;
  EXPECT_NE(stiffness_text(box).find("with links of 0.05..0.3 kg m2\n"), std::string::npos)
      << stiffness_text(box);
  box.cells[0].stiffness_Nm_rad.to *= 0.9;
  box.cells[0].link_inertia_kgm2 = box.link_inertia_kgm2;
  EXPECT_NE(stiffness_text(box).find("within a cell only, whatever the link"), std::string::npos)
      << stiffness_text(box);
}

}  // namespace
}  // namespace strainwave
