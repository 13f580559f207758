// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/flexible_report.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

FlexibleRow row(double step_rad, double judged, double first, double second) {
  FlexibleRow row;
  row.cell.step_rad = step_rad;
  for (const double ratio : {first, judged, second}) {
    row.results.emplace_back();
    row.results.back().link_counted_ratio = ratio;
  }
  return row;
}

TEST(FlexibleReport, NamesEveryCellInWhichTheJudgedIsNotBetter) {
  const std::vector<Contender> contenders = {{"first", {}}, {"judged", {}}, {"second", {}}};
  const TextTable lost = lost_cells(
      {row(0.001, 1.1, 2.0, 3.0), row(0.01, 1.5, 1.5, 1.6), row(0.1, 1.3, 1.4, 1.2)}, contenders, 1);
  ASSERT_EQ(lost.rows.size(), 2U);
  EXPECT_EQ(lost.rows[0].front(), "first") << "a tie is lost";
  EXPECT_EQ(lost.rows[0][5], "0.01");
  EXPECT_EQ(lost.rows[1].front(), "second");
  EXPECT_EQ(lost.rows[1][5], "0.1");
  EXPECT_EQ(lost.rows[1][6], "1.3");
  EXPECT_EQ(lost.rows[1][7], "1.2");
  EXPECT_EQ(lost.header.size(), lost.rows[0].size());
}

}  // namespace
}  // namespace strainwave
