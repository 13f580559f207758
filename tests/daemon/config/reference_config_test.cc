// SPDX-License-Identifier: BSD-3-Clause
// config/reference.toml contains every key that the configuration code reads, and no other.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/text_file.h"
#include "daemon/config/config.h"

namespace strainwave {
namespace {

// Keys that the code reads: the literal in section.number_or("key", ...) and similar calls.
std::set<std::string> keys_in_code() {
  const std::regex asks(
      R"re(\b(?:number|number_or|integer|integer_or|boolean_or|text|text_or|choice|choice_or|numbers|section|section_or_empty|sections|read_name)\(\s*(?:\w+,\s*)?"([A-Za-z0-9_]+)")re");
  std::set<std::string> keys;
  for (const auto& entry : std::filesystem::directory_iterator(STRAINWAVE_SOURCE_DIR "/daemon/config")) {
    const std::string name = entry.path().filename().string();
    if (name.rfind("config", 0) != 0 || entry.path().extension() != ".cc") continue;
    const std::string text = read_text_file(entry.path());
    for (std::sregex_iterator it(text.begin(), text.end(), asks), end; it != end; ++it) keys.insert((*it)[1]);
  }
  return keys;
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> names;
  std::istringstream stream(path);
  for (std::string name; std::getline(stream, name, '.');) names.push_back(name);
  return names;
}

// Keys and table names of the file, commented-out examples included.
std::set<std::string> keys_in_reference() {
  std::set<std::string> keys;
  std::istringstream lines(read_text_file(STRAINWAVE_SOURCE_DIR "/config/reference.toml"));
  const std::regex assignment(R"(^(?:# )?([A-Za-z0-9_]+) = )");
  const std::regex header(R"(^(?:# )?\[+([a-z_.]+)\]+)");
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, assignment)) keys.insert(match[1]);
    if (std::regex_search(line, match, header))
      for (const std::string& name : split(match[1])) keys.insert(name);
  }
  return keys;
}

TEST(ReferenceConfiguration, NamesEveryKeyThatIsReadAndNoOther) {
  std::set<std::string> in_code = keys_in_code();
  for (const char* driver : {"simulated", "can", "gpio"})
    in_code.insert(driver);  // a driver's section is named after it
  EXPECT_GT(in_code.size(), 40U);
  EXPECT_EQ(in_code, keys_in_reference());
}

}  // namespace
}  // namespace strainwave
