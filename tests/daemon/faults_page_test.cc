// SPDX-License-Identifier: BSD-3-Clause
// Compares docs/faults.md with the table of injected faults.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "base/text_file.h"
#include "tests/daemon/realtime/joint/injected_fault_table.h"
#include "tests/support/message_files.h"

namespace strainwave::testing {
namespace {

const std::filesystem::path kSource = STRAINWAVE_SOURCE_DIR;
using Row = std::vector<std::string>;

std::string trimmed(const std::string& cell) {
  const std::size_t first = cell.find_first_not_of(" `");
  return first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" `") - first + 1);
}

/// Rows of all tables under "## title", without their two header lines.
std::vector<Row> rows_under(const std::string& title) {
  std::istringstream page(read_text_file(kSource / "docs" / "faults.md"));
  std::vector<Row> rows;
  bool inside = false;
  bool previous_was_row = false;
  int header = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) inside = line == "## " + title;
    const bool is_row = inside && line.starts_with("|");
    if (is_row && !previous_was_row) header = 2;
    previous_was_row = is_row;
    if (!is_row || header-- > 0) continue;
    Row row;
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
    rows.push_back(row);
  }
  return rows;
}

std::string doing_text(Doing doing) {
  switch (doing) {
    case Doing::kHolding:
      return "holding";
    case Doing::kMoving:
      return "moving";
    case Doing::kHoldingThenMoving:
      return "holding, then a move";
  }
  return "";
}

std::string reaction_text(const InjectedFaultCase& entry) {
  if (entry.reaction == Reaction::kNone) return "none: tolerated";
  if (entry.reaction == Reaction::kTemperatureUnknown) return "`temperature_status`; goes on";
  std::string text = "fault ";
  for (const Fault fault : entry.faults)
    text += (fault == entry.faults.front() ? "" : " or ") + std::to_string(static_cast<int>(fault));
  return text;
}

std::string expected_row(const InjectedFaultCase& entry) {
  std::ostringstream row;
  row << "| `" << to_text(entry.injection.kind) << "` | ";
  if (entry.injection.amount != 0.0) row << entry.injection.amount << " ";
  row << "| " << doing_text(entry.doing) << " | " << reaction_text(entry) << " | ";
  if (entry.reaction != Reaction::kNone) row << entry.within_cycles << " ";
  row << "|";
  return row.str();
}

TEST(FaultsPage, PromisesOfInjectedFaultsWhatTheLoopIsTestedFor) {
  const std::string page = read_text_file(kSource / "docs" / "faults.md");
  std::size_t promises = 0;
  for (const InjectedFaultCase& entry : injected_fault_table()) {
    EXPECT_NE(page.find("\n" + expected_row(entry) + "\n"), std::string::npos) << "missing:\n"
                                                                               << expected_row(entry);
    ++promises;
  }
  EXPECT_EQ(rows_under("Injected faults").size(), promises + kInjectedFaultCount)
      << "a promise that nothing tests";
}

TEST(FaultsPage, ListsEveryKindOfInjectedFault) {
  const auto rows = rows_under("Injected faults");
  for (std::size_t kind = 0; kind < kInjectedFaultCount; ++kind) {
    EXPECT_EQ(rows.at(kind).at(0), std::to_string(kind));
    EXPECT_EQ(rows.at(kind).at(1), to_text(static_cast<InjectedFault>(kind)));
  }
}

}  // namespace
}  // namespace strainwave::testing
