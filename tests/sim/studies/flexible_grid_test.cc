// README's table of the flexible joint, of the whole grid.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/studies/flexible_study.h"

namespace strainwave {
namespace {

/// The row `name` of README's table as it is printed: one number for each step of the grid.
std::vector<std::string> readme_row(const std::string& name) {
  std::ifstream readme(std::filesystem::path(STRAINWAVE_SOURCE_DIR) / "README.md");
  std::vector<std::string> printed;
  for (std::string line; printed.empty() && std::getline(readme, line);) {
    if (line.rfind("| " + name + " |", 0) != 0) continue;
    std::istringstream fields(line.substr(name.size() + 4));
    std::string number;
    for (std::string times, bar; printed.size() < 4 && fields >> number >> times >> bar;)
      printed.push_back(number);
  }
  return printed;
}

/// One unit of the last digit of a printed number: "12.6" has 0.1.
double last_digit(const std::string& printed) {
  const std::size_t point = printed.find('.');
  return point == std::string::npos ? 1.0 : std::pow(10.0, -static_cast<double>(printed.size() - point - 1));
}

const std::vector<std::pair<const char*, const char*>> kSaid = {
    {"PID", "PID of the source"},
    {"C4", "scheduled controller alone (C4)"},
    {"daemon", "the daemon's controller, as it is by default"},
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
    const std::vector<std::string> printed = readme_row(kSaid[c].second);
    ASSERT_EQ(printed.size(), logarithms.size()) << kSaid[c].second;
    std::size_t column = 0;
    for (const auto& [step_rad, of_step] : logarithms) {
      const std::string& number = printed[column++];
      EXPECT_NEAR(std::exp(of_step.first / of_step.second), std::stod(number), last_digit(number))
          << kSaid[c].first << ", " << step_rad << " rad";
    }
  }
}

}  // namespace
}  // namespace strainwave
