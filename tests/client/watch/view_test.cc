// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

WatchedJoint joint(const std::string& prefix, const std::string& name, Mode mode) {
  WatchedJoint watched;
  watched.prefix = prefix;
  watched.joint = name;
  watched.view.state.mode = static_cast<std::int32_t>(mode);
  watched.view.state.rule_count = 5;
  watched.view.state.joint_position_rad = 0.25;
  watched.view.state.temperature_weights[1] = 1.0;
  return watched;
}

WatchModel model(int joints) {
  WatchModel model;
  model.daemons.push_back({"SW", {}, 0.1});
  for (int i = 0; i < joints; ++i)
    model.joints.push_back(joint("SW", "joint" + std::to_string(i), Mode::kHolding));
  model.has_key = true;
  return model;
}

std::string all_text(const Screen& screen) {
  std::string text;
  for (int row = 0; row < screen.rows(); ++row) text += screen.text(row) + "\n";
  return text;
}
bool shows(const Screen& screen, const std::string& text) {
  return all_text(screen).find(text) != std::string::npos;
}

int row_of(const Screen& screen, const std::string& text) {
  for (int row = 0; row < screen.rows(); ++row)
    if (screen.text(row).find(text) != std::string::npos) return row;
  return -1;
}

TEST(WatchView, ShowsWhatEveryJointDoesAndWhichKeysThereAre) {
  const Screen screen = render(model(2), 24, 160);
  for (const char* part :
       {"joint0", "joint1", "holding", "+0.250000", "SW: ", "s stop", "e enable", "sensor", "? help"})
    EXPECT_TRUE(shows(screen, part)) << part << "\n" << all_text(screen);
}

TEST(WatchView, IsDrawnInAnySizeWithoutLosingModeOrStop) {
  for (int rows = 0; rows < 60; rows += 1) {
    for (int columns = 0; columns < 250; columns += 7) {
      for (const int joints : {0, 1, 3, 40}) {
        const Screen screen = render(model(joints), rows, columns);
        ASSERT_EQ(screen.rows(), rows);
        ASSERT_EQ(screen.columns(), columns);
        if (rows >= 6 && columns >= 30 && joints > 0) {
          EXPECT_TRUE(shows(screen, "holding")) << rows << " x " << columns;
          EXPECT_TRUE(shows(screen, "s stop")) << rows << " x " << columns;
        }
      }
    }
  }
}

TEST(WatchView, KeepsTheSelectedJointInSight) {
  WatchModel many = model(100);
  for (many.selected = 0; many.selected < 100; ++many.selected) {
    const Screen screen = render(many, 20, 100);
    const int row = row_of(screen, ">joint" + std::to_string(many.selected) + " ");
    ASSERT_GE(row, 0) << many.selected;
    EXPECT_TRUE(screen.at(row, 1).marked);
  }
}

TEST(WatchView, NamesWhoIsInTroubleOutOfSight) {
  WatchModel many = model(40);
  EXPECT_FALSE(shows(render(many, 24, 80), "FAULT"));
  many.joints[39].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  many.joints[38].age_s = 2.5;
  const Screen screen = render(many, 24, 80);
  for (int row = 1; row < screen.rows(); ++row)
    ASSERT_EQ(screen.text(row).find("joint39"), std::string::npos) << "it would be seen\n"
                                                                   << all_text(screen);
  const std::string title = screen.text(0);
  const auto place = title.find("FAULT or SILENCE: joint38, joint39");
  ASSERT_NE(place, std::string::npos) << title;
  EXPECT_EQ(screen.at(0, static_cast<int>(place)).style, Style::kAlarm);
  for (WatchedJoint& joint : many.joints) joint.age_s = 2.5;
  EXPECT_EQ(render(many, 24, 80).text(0),
            "FAULT or SILENCE: joint0, joint1, joint2, joint3, joint4, joint5 and 34 more");
}

TEST(WatchView, TellsJointsWithLongNamesApart) {
  WatchModel two = model(0);
  for (const char* name : {"shoulder_left_front_roll", "shoulder_left_front_yaw"})
    two.joints.push_back(joint("SW", name, Mode::kHolding));
  const Screen screen = render(two, 24, 80);
  EXPECT_TRUE(shows(screen, ">shoulder_left_front_roll holding")) << all_text(screen);
  EXPECT_TRUE(shows(screen, " shoulder_left_front_yaw  holding")) << all_text(screen);
  EXPECT_TRUE(shows(screen, "joint    shoulder_left_front_roll holding, target")) << all_text(screen);
  const Screen narrow = render(two, 24, 40);
  EXPECT_TRUE(shows(narrow, ">shoulder_..ront_roll")) << all_text(narrow);
  EXPECT_TRUE(shows(narrow, " shoulder_..front_yaw")) << all_text(narrow);
}

TEST(WatchView, CutsNoNumber) {
  WatchModel one = model(1);
  timing_v1& timing = one.daemons[0].timing;
  timing.overruns = 123456;
  timing.wakeup_latency_max_ns = 234567000;
  timing.execution_time_max_ns = 345678000;
  timing.rejects[static_cast<int>(Reason::kOldSequence)] = 456789;
  for (const double age_s : {0.1, 12345.0}) {
    one.daemons[0].age_s = age_s;
    for (int columns = 30; columns < 140; ++columns) {
      const std::string line = render(one, 24, columns).text(1);
      EXPECT_TRUE(line.ends_with("...") || line.ends_with(" ms") || line.ends_with(" us") ||
                  line.ends_with(" overruns") || line.ends_with(" refused"))
          << line;
      if (columns >= 80 && age_s < 1.0) {
        EXPECT_NE(line.find("456789 refused"), std::string::npos) << line;
      }
    }
  }
}

TEST(WatchView, SetsAFaultASilenceAndALimitApart) {
  WatchModel three = model(4);
  three.joints[1].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  three.joints[1].view.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  three.joints[2].age_s = 2.5;
  three.joints[3].view.state.notices = static_cast<std::int32_t>(Notice::kTorqueLimited);
  const Screen screen = render(three, 24, 160);
  const auto style = [&](const std::string& name) {
    return screen.at(row_of(screen, " " + name + " "), 1).style;
  };
  EXPECT_EQ(style("joint1"), Style::kAlarm);
  EXPECT_EQ(style("joint2"), Style::kAlarm);
  EXPECT_EQ(style("joint3"), Style::kWarning);
  EXPECT_TRUE(shows(screen, "fault 14: following error"));
  EXPECT_TRUE(shows(screen, "no message for 2.5 s"));
  EXPECT_TRUE(shows(screen, "torque limited"));
}

TEST(WatchView, NamesTheDaemonOfAJointWhenThereAreSeveral) {
  WatchModel two = model(1);
  EXPECT_FALSE(shows(render(two, 24, 160), "SW.joint0"));
  two.joints.push_back(joint("ARM2", "joint0", Mode::kOff));
  EXPECT_TRUE(shows(render(two, 24, 160), "SW.joint0"));
  EXPECT_TRUE(shows(render(two, 24, 160), "ARM2.joint0"));
}

TEST(WatchView, OffersOrdersToDaemonsThatTakeThemUnsigned) {
  WatchModel unsigned_model = model(1);
  unsigned_model.has_key = false;
  const Screen screen = render(unsigned_model, 24, 160);
  EXPECT_TRUE(shows(screen, "e enable"));
  EXPECT_TRUE(shows(screen, "commands are not signed"));
}

TEST(WatchView, AFaultKeepsItsColourWhenItsJointIsSelected) {
  WatchModel one = model(2);
  one.joints[0].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  for (const auto& [rows, columns] : {std::pair(24, 80), std::pair(40, 120), std::pair(50, 200)}) {
    const Screen screen = render(one, rows, columns);
    const int row = row_of(screen, ">joint0");
    ASSERT_GE(row, 0);
    for (const int column : {1, 14, 24}) EXPECT_EQ(screen.at(row, column).style, Style::kAlarm) << column;
    EXPECT_TRUE(screen.at(row, 1).marked) << "and is seen to be selected";
    EXPECT_FALSE(screen.at(row_of(screen, " joint1"), 1).marked);
  }
}

TEST(WatchView, ShowsTheNumbersOfAJointOn80By24) {
  WatchModel one = model(2);
  state_v1& state = one.joints[0].view.state;
  state.setpoint_position_rad = 0.25002;
  state.torque_applied_Nm = -4.702;
  state.temperature_used_C = -9.5;
  const Screen screen = render(one, 24, 80);
  const std::string row = screen.text(row_of(screen, ">joint0"));
  for (const char* part : {"holding", "+0.250000", "+2.0e-05", "-4.702", "-9.5"})
    EXPECT_NE(row.find(part), std::string::npos) << part << " in " << row;
  for (int empty = 0, r = 0; r < 24; ++r) {
    empty += screen.text(r).empty();
    EXPECT_LE(empty, 4) << all_text(screen);
  }
}

TEST(WatchView, ShowsNoNumberForATemperatureThatWasNeverSeen) {
  WatchModel one = model(1);
  state_v1& state = one.joints[0].view.state;
  state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  state.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kNeverSeen);
  for (const auto& [rows, columns] : {std::pair(24, 80), std::pair(50, 200)}) {
    const std::string text = all_text(render(one, rows, columns));
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
    EXPECT_NE(text.find("temperature never seen"), std::string::npos) << text;
  }
  EXPECT_NE(render(one, 24, 80).text(row_of(render(one, 24, 80), ">joint0")).find("     -"),
            std::string::npos);
}

TEST(WatchView, HasRoomForWhatItKnowsOfTheSelectedJoint) {
  WatchModel one = model(1);
  one.joints[0].limits.emplace();
  one.joints[0].limits->position_min_rad = -3.0;
  one.joints[0].limits->position_max_rad = 3.0;
  one.joints[0].limits->torque_limit_Nm = 34.0;
  one.joints[0].history.error_rad = {0.0, 1e-3};
  one.refusals = {{"SW.joint0: enable: refused, joint is faulted", 12.0}};
  one.daemons[0].timing.rejects[static_cast<int>(Reason::kOldSequence)] = 3;
  for (const auto& [rows, columns] : {std::pair(24, 80), std::pair(40, 120), std::pair(50, 200)}) {
    const Screen screen = render(one, rows, columns);
    for (const char* part :
         {"torque 34 N.m", "12 s ago: SW.joint0: enable: refused", "3 ", "error_rad", "torque_Nm"})
      EXPECT_TRUE(shows(screen, part)) << part << "\n" << all_text(screen);
  }
}

TEST(WatchView, ShowsTheWholeOfALongRefusalOnEveryTerminal) {
  WatchModel one = model(1);
  // As long as ack_v1.text allows.
  std::string reason = "SW.joint0: enable: refused, drive is not ready:";
  while (reason.size() < 270) reason += " word" + std::to_string(reason.size());
  one.message = reason + " END";
  one.message_alarm = true;
  one.refusals = {{one.message, 4.0}, {"SW.joint0: older", 60.0}};
  for (const auto& [rows, columns] : {std::pair(24, 80), std::pair(40, 120), std::pair(50, 200)}) {
    const Screen screen = render(one, rows, columns);
    const std::string text = all_text(screen);
    const auto first = text.find("END");
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_NE(text.find("END", first + 1), std::string::npos) << "in the detail and below it\n" << text;
    EXPECT_TRUE(shows(screen, "60 s ago: SW.joint0: older")) << text;
    EXPECT_TRUE(shows(screen, "s stop")) << text;
  }
}

TEST(WatchView, ExplainsItsKeys) {
  WatchModel asked = model(1);
  asked.help = true;
  const Screen screen = render(asked, 24, 80);
  for (const char* part : {"jog", "clear a fault", "needs no key", "error_rad"})
    EXPECT_TRUE(shows(screen, part)) << part << "\n" << all_text(screen);
}

TEST(WatchView, ExplainsAllOfThemOnSmallTerminals) {
  WatchModel asked = model(1);
  asked.help = true;
  asked.message = "SW.joint0: enable: refused, joint is faulted: " + std::string(200, 'x');
  EXPECT_TRUE(shows(render(asked, 24, 80), "a daemon may refuse them"))
      << all_text(render(asked, 24, 80)) << "the last of it";
  std::istringstream words(all_text(render(asked, 60, 40)));
  std::string narrow;
  for (std::string word; words >> word;) narrow += word + " ";
  for (const char* part :
       {"needs no key and no session", "when the position was measured", "docs/faults.md explains each"})
    EXPECT_NE(narrow.find(part), std::string::npos) << part << "\n" << narrow;
  EXPECT_TRUE(shows(render(asked, 24, 40), "a larger terminal shows more"));
}

TEST(WatchView, ShowsWhereTheTemperatureComesFrom) {
  WatchModel one = model(1);
  one.joints[0].temperature.emplace();
  one.joints[0].temperature->age_s = 0.3;
  EXPECT_TRUE(shows(render(one, 24, 160), "sensor, 0.3 s"));
  one.joints[0].view.state.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kTooOld);
  EXPECT_TRUE(shows(render(one, 24, 160), "too old"));
}

TEST(WatchView, HostileStatesAreDrawnAsWell) {
  WatchModel hostile = model(1);
  state_v1& state = hostile.joints[0].view.state;
  state.rule_count = 1'000'000;
  state.mode = -77;
  state.joint_position_rad = 1e300;
  state.setpoint_position_rad = std::nan("");
  state.temperature_weights[0] = std::nan("");
  state.temperature_weights[1] = -1e9;
  hostile.joints[0].limits.emplace();  // the limits' min and max are equal
  for (const double value : {1e300, -1e300, std::nan(""), 0.0}) {
    hostile.joints[0].history.error_rad.push_back(value);
    hostile.joints[0].history.torque_Nm.push_back(value);
  }
  for (const int columns : {30, 80, 300}) render(hostile, 24, columns);
  hostile.selected = 17;
  render(hostile, 24, 80);
  hostile.selected = -3;
  render(hostile, 24, 80);
}

}  // namespace
}  // namespace strainwave
