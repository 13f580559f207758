// SPDX-License-Identifier: BSD-3-Clause
// Compares docs/can.md with the code: every fault detail with its number and name.
#include <gtest/gtest.h>

#include <map>
#include <regex>

#include "base/text_file.h"
#include "drivers/can/can_detail.h"

namespace strainwave {
namespace {

std::map<int, std::string> matches(const std::string& text, const std::regex& pattern, std::size_t number,
                                   std::size_t name) {
  std::map<int, std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    found[std::stoi((*it)[number])] = (*it)[name];
  return found;
}

TEST(CanPage, ListsEveryDetailWithItsNumberAndName) {
  const std::string header = read_text_file(STRAINWAVE_SOURCE_DIR "/drivers/can/can_detail.h");
  const std::size_t begin = header.find("enum class CanDetail");
  const auto declared =
      matches(header.substr(begin, header.find("};", begin) - begin), std::regex(R"((k\w+) = (\d+))"), 2, 1);
  const auto documented = matches(read_text_file(STRAINWAVE_SOURCE_DIR "/docs/can.md"),
                                  std::regex(R"(\| (\d+) \| `(k\w+)` \|)"), 1, 2);
  ASSERT_GT(declared.size(), 10U);
  EXPECT_EQ(documented, declared);
  for (const auto& [number, name] : declared)
    EXPECT_NE(can_detail_text(drive_error_of(static_cast<CanDetail>(number))), "unknown detail") << name;
}

}  // namespace
}  // namespace strainwave
