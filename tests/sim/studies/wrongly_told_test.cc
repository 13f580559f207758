// The page's table of joints that are told wrongly, of the whole grid and of a thousand joints drawn at random.
#include "sim/studies/wrongly_told.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace strainwave {
namespace {

using Row = std::vector<std::string>;

/// The fields of the page's table row that begins with `name`; none where there is no such row.
Row page_row(const std::string& name) {
  std::ifstream page(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "docs" / "flexible-joint.md");
  Row fields;
  for (std::string line; fields.empty() && std::getline(page, line);) {
    if (line.rfind("| " + name + " |", 0) != 0) continue;
    std::istringstream rest(line.substr(2));
    for (std::string field; std::getline(rest, field, '|');) fields.push_back(field);
  }
  return fields;
}

std::vector<std::string> numbers_of(const std::string& field) {
  const std::regex number("[0-9.]+(e[+-][0-9]+)?");
  return {std::sregex_token_iterator(field.begin(), field.end(), number), std::sregex_token_iterator()};
}

/// One unit of the last digit of a printed number: "12.6" has 0.1.
double unit_of(const std::string& printed) {
  const std::size_t point = printed.find('.');
  return point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(printed.size() - point - 1));
}

// Every number of the page, but for one of its last digit.
void expect_row_of_page(const Row& computed) {
  const Row said = page_row(computed.front());
  ASSERT_EQ(said.size(), computed.size()) << computed.front();
  for (std::size_t i = 1; i < computed.size(); ++i) {
    const auto expected = numbers_of(said[i]);
    const auto found = numbers_of(computed[i]);
    ASSERT_EQ(expected.size(), found.size()) << computed.front() << ": " << said[i];
    for (std::size_t k = 0; k < expected.size(); ++k)
      EXPECT_NEAR(std::stod(found[k]), std::stod(expected[k]), 1.01 * unit_of(expected[k]))
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
