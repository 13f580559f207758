// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/state_csv.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <random>
#include <sstream>

#include "lcmtypes/reading_doubt.h"

namespace strainwave {
namespace {

std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

TEST(StateCsv, HasTheWeightsInUseAndWordsForNumbers) {
  const std::vector<std::string> names = columns(state_csv_columns(3));
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const char* name : {"temperature_weights_2", "mode", "mode_text", "fault_text", "joint_position_rad"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("temperature_weights_3"));
  state_v1 state{};
  state.mode = 6;
  state.fault = 14;
  state.rule_count = 2;
  const std::vector<std::string> row = columns(state_csv_values(state, 3));
  ASSERT_EQ(row.size(), names.size());
  const auto at = [&](const char* name) {
    return row[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  EXPECT_EQ(at("mode_text"), "homing");
  EXPECT_EQ(at("fault_text"), "following error");
  state.fault = 5;
  state.drive_error = doubt_number(ReadingDoubt::kJump, 0.05);
  EXPECT_NE(state_csv_values(state, 3).find(
                ",5,implausible reading: the position jumped by 0.05 rad from one reading to the next,"),
            std::string::npos)
      << state_csv_values(state, 3);
  EXPECT_EQ(at("temperature_weights_1"), "0");
  EXPECT_EQ(at("temperature_weights_2"), "") << "this state has two rules";
}

TEST(StateCsv, ReadsBackToTheSameBits) {
  std::mt19937_64 random(20240601);
  for (int run = 0; run < 200; ++run) {
    state_v1 state{};
    double& value = state.joint_position_rad;
    do {
      value = std::bit_cast<double>(random());
    } while (value != value);  // a NaN is written as "nan", without its payload
    state.session_id = static_cast<std::int64_t>(random());
    const std::vector<std::string> row = columns(state_csv_values(state, 16));
    const std::vector<std::string> header = columns(state_csv_columns(16));
    ASSERT_EQ(row.size(), header.size());
    const auto at = [&](const char* name) {
      return row[static_cast<std::size_t>(std::find(header.begin(), header.end(), name) - header.begin())];
    };
    const std::string text = at("joint_position_rad");
    double read = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), read);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
    EXPECT_EQ(at("session_id"), std::to_string(state.session_id));
  }
}

}  // namespace
}  // namespace strainwave
