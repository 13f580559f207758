// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/message_fields.h"

#include <gtest/gtest.h>

#include "tests/support/message_files.h"

namespace strainwave {
namespace {

template <typename Message>
void expect_fields(const std::string& type) {
  std::vector<std::string> visited;
  visit_fields(Message{}, [&](const char* name, const auto&) { visited.emplace_back(name); });
  std::vector<std::string> declared;
  for (const MessageField& field :
       read_message_fields(std::string(STRAINWAVE_SOURCE_DIR) + "/lcmtypes/" + type + ".lcm", type)) {
    if (field.name != "key_id" && field.name != "signature") declared.push_back(field.name);
  }
  ASSERT_FALSE(declared.empty()) << type;
  EXPECT_EQ(visited, declared) << type;
}

TEST(MessageFields, AreThoseOfEachMessageInItsOrder) {
  expect_fields<state_v1>("state_v1");
  expect_fields<temperature_v1>("temperature_v1");
  expect_fields<timing_v1>("timing_v1");
  expect_fields<limits_v1>("limits_v1");
  expect_fields<setpoint_v1>("setpoint_v1");
  expect_fields<command_v1>("command_v1");
  expect_fields<inject_v1>("inject_v1");
  expect_fields<ack_v1>("ack_v1");
}

}  // namespace
}  // namespace strainwave
