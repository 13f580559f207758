// SPDX-License-Identifier: BSD-3-Clause
#include "tests/telemetry/acting_fixture.h"

#include <limits>
#include <nlohmann/json.hpp>

namespace strainwave {

ActingTest::ActingTest() : key_(write_new_key(folder_.path() / "key", Role::kOperator, "bench").key) {
  for (const char* joint : {"elbow", "knee"}) {
    state_v1 state{};
    state.session_id = 42;
    state.challenge = 7;
    state.joint_position_rad = 0.5;
    state.link_position_rad = std::numeric_limits<double>::quiet_NaN();
    fleet_.take({"SW", joint, "STATE"}, state, 0.0);
  }
  limits_v1 limits{};
  limits.session_id = 42;
  limits.position_min_rad = -2.0;
  limits.position_max_rad = 2.0;
  limits.speed_limit_rad_s = 4.0;
  limits.acceleration_rad_s2 = limits.deceleration_rad_s2 = 30.0;
  fleet_.take({"SW", "elbow", "LIMITS"}, limits, 0.0);
}

void ActingTest::take(const Acting::Page& page, const Json& order) {
  Json text = order;
  text["op"] = "act";
  acting_.take(page, read_page_order(text), now_s_);
}

void ActingTest::open(const Acting::Page& page) {
  take(page, {{"action", "open"}, {"token", acting_.token()}});
}

ActingTest::Json ActingTest::order(const std::string& action, const std::string& joint) {
  return {{"action", action}, {"joint", joint}, {"session_id", "42"}, {"challenge", "9223372036854775807"}};
}

ActingTest::Json ActingTest::jog(int number, double velocity_rad_s, const std::string& joint) {
  Json json = order("jog", joint);
  json["jog"] = number;
  json["velocity_rad_s"] = velocity_rad_s;
  return json;
}

ActingTest::Json ActingTest::said(const Acting::Page& page) const {
  return texts_.contains(page.number) ? Json::parse(texts_.at(page.number)) : Json();
}

void ActingTest::begin_jog(const Acting::Page& page, int number) {
  open(page);
  take(page, jog(number, 0.2));
  ASSERT_EQ(setpoints().size(), 1U) << said(page);
  acknowledge();
}

}  // namespace strainwave
