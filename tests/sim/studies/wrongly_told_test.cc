// The page's table of joints that are told wrongly, of the whole grid and of a thousand joints drawn at random.
#include "sim/studies/wrongly_told.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/sim/studies/printed_table.h"

namespace strainwave {
namespace {

using Row = std::vector<std::string>;

// Every number of the page, but for one of its last digit.
void expect_row_of_page(const Row& computed) {
  const Row said = printed_row("docs/flexible-joint.md", computed.front());
  ASSERT_EQ(said.size() + 1, computed.size()) << computed.front();
  for (std::size_t i = 1; i < computed.size(); ++i) {
    const auto expected = printed_numbers(said[i - 1]);
    const auto found = printed_numbers(computed[i]);
    ASSERT_EQ(expected.size(), found.size()) << computed.front() << ": " << said[i - 1];
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(std::stod(found[k]), std::stod(expected[k]), 1.01 * last_digit(expected[k]))
          << computed.front() << ": " << computed[i];
  }
}

TEST(WronglyTold, FindsEveryDigitOfThePagesTableAndNoJointThatOscillates) {
  const FlexibleTables gains =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  for (const Contender& contender : flexible_contenders(gains, false)) {
    if (contender.name != "daemon told of its spring") continue;
    for (const auto& cells : {wrongly_told_grid(), wrongly_told_joints(1000, 1)}) {
      const auto rows = run_wrongly_told(cells, contender);
      for (const WronglyToldRow& row : rows)
        EXPECT_FALSE(row.result.oscillates) << row.cell.effect << ", link " << row.cell.link_inertia_kgm2;
      for (const Row& row : wrongly_told_summary(rows).rows)
        if (row.front() != "none") expect_row_of_page(row);
    }
    return;
  }
  FAIL() << "no such contender";
}

}  // namespace
}  // namespace strainwave
