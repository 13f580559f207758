#include "client/text/state_fields.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <random>
#include <sstream>

#include "client/text/state_csv.h"
#include "tests/support/message_files.h"

namespace strainwave {
namespace {

std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

std::vector<MessageField> declared_fields() {
  return read_message_fields(STRAINWAVE_SOURCE_DIR "/lcmtypes/state_v1.lcm", "state_v1");
}

TEST(StateFields, AreThoseOfTheMessageInItsOrder) {
  std::vector<std::string> visited;
  visit_state_fields(state_v1{}, [&](const char* name, const auto&) { visited.emplace_back(name); });
  std::vector<std::string> declared;
  for (const MessageField& field : declared_fields()) declared.push_back(field.name);
  ASSERT_FALSE(declared.empty());
  EXPECT_EQ(visited, declared);
}

TEST(StateCsv, NamesItsColumnsAsTheMessageNamesItsFields) {
  std::vector<std::string> expected{"joint"};
  for (const MessageField& field : declared_fields()) {
    for (int i = 0; i < field.count; ++i) {
      expected.push_back(field.count == 1 ? field.name : field.name + "_" + std::to_string(i));
    }
  }
  EXPECT_EQ(columns(csv_header()), expected);
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
    const std::vector<std::string> row = columns(csv_row("elbow", state));
    const std::vector<std::string> header = columns(csv_header());
    ASSERT_EQ(row.size(), header.size());
    EXPECT_EQ(row.front(), "elbow");
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
