// SPDX-License-Identifier: BSD-3-Clause
// The documentation of the messages must contain every declared field with its type, in the declared order.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <sstream>

#include "base/text_file.h"
#include "tests/support/message_files.h"

namespace strainwave {
namespace {

const std::filesystem::path kSource = STRAINWAVE_SOURCE_DIR;

using Row = std::vector<std::string>;

std::string trimmed(const std::string& cell) {
  const std::size_t first = cell.find_first_not_of(" `");
  if (first == std::string::npos) return "";
  return cell.substr(first, cell.find_last_not_of(" `") - first + 1);
}

/// Rows of the table under "## title" of any of the pages, without its two header lines; cells without blanks and back-quotes.
std::vector<Row> table_under(const std::string& title) {
  std::istringstream page(read_text_file(kSource / "docs/messages.md") +
                          read_text_file(kSource / "docs/commands.md") +
                          read_text_file(kSource / "docs/gain-table.md"));
  std::vector<Row> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("#")) inside = line == "## " + title;
    if (!inside || !line.starts_with("|")) continue;
    Row row;
    std::istringstream cells(line.substr(1));
    for (std::string cell; std::getline(cells, cell, '|');) row.push_back(trimmed(cell));
    rows.push_back(row);
  }
  if (rows.size() < 2) return {};
  rows.erase(rows.begin(), rows.begin() + 2);
  return rows;
}

/// Every struct of lcmtypes/*.lcm with its file.
std::map<std::string, std::filesystem::path> declared_messages() {
  std::map<std::string, std::filesystem::path> messages;
  for (const auto& entry : std::filesystem::directory_iterator(kSource / "lcmtypes")) {
    if (entry.path().extension() != ".lcm") continue;
    const std::string text = read_text_file(entry.path());
    const std::regex declaration(R"(struct (\w+))");
    for (std::sregex_iterator it(text.begin(), text.end(), declaration); it != std::sregex_iterator(); ++it) {
      messages[(*it)[1]] = entry.path();
    }
  }
  return messages;
}

TEST(MessagesPages, ListsEveryFieldOfEveryMessageInItsOrder) {
  const auto messages = declared_messages();
  ASSERT_GE(messages.size(), 8U);
  for (const auto& [name, file] : messages) {
    std::vector<Row> declared;
    for (const MessageField& field : read_message_fields(file, name))
      declared.push_back({field.declaration, field.type});
    std::vector<Row> documented;
    for (const Row& row : table_under(name)) documented.push_back({row.at(0), row.at(1)});
    ASSERT_FALSE(declared.empty()) << name;
    EXPECT_EQ(documented, declared) << name;
  }
}

}  // namespace
}  // namespace strainwave
