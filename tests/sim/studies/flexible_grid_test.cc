// README's table of the flexible joint, of the whole grid.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "sim/studies/flexible_study.h"
#include "tests/sim/studies/printed_table.h"

namespace strainwave {
namespace {

const std::vector<std::pair<const char*, const char*>> kSaid = {
    {"PID", "PID of the source"},
    {"C4", "scheduled controller alone (C4)"},
    {"daemon", "the daemon's controller without a model of the spring"},
    {"daemon told of its spring", "the daemon's controller told of its spring"},
    {"declared rigid", "the daemon's with every part on, as for a rigid joint"}};

// Geometric means over the limit of the link, above 40 urad. The simulation has no chance in it: every digit is held, but for half of
// the last one, that it is rounded to, and as much again for another compiler's.
TEST(FlexibleGrid, FindsEveryDigitOfTheReadmesTable) {
  const FlexibleTables tables =
      read_flexible_tables(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "data" / "tables");
  std::vector<Contender> contenders;
  for (const auto& [name, row] : kSaid)
    for (const Contender& candidate : flexible_contenders(tables, true))
      if (candidate.name == name) contenders.push_back(candidate);
  ASSERT_EQ(contenders.size(), kSaid.size());
  const auto rows = run_flexible(flexible_grid(), contenders, [](std::size_t) {});
  for (std::size_t c = 0; c < kSaid.size(); ++c) {
    std::map<double, std::pair<double, int>> logarithms;  // their sum and number, by step
    for (const FlexibleRow& row : rows) {
      auto& [sum, count] = logarithms[row.cell.step_rad];
      sum += std::log(row.results[c].link_counted_ratio);
      ++count;
    }
    const std::vector<std::string> printed = printed_row("README.md", kSaid[c].second);
    ASSERT_EQ(printed.size(), logarithms.size()) << kSaid[c].second;
    std::size_t column = 0;
    for (const auto& [step_rad, of_step] : logarithms) {
      const std::string number = printed_numbers(printed[column++]).at(0);
      EXPECT_NEAR(std::exp(of_step.first / of_step.second), std::stod(number), last_digit(number))
          << kSaid[c].first << ", " << step_rad << " rad";
    }
  }
}

}  // namespace
}  // namespace strainwave
