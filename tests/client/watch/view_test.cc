#include "client/watch/view.h"

#include <gtest/gtest.h>

#include <cmath>

#include "lcmtypes/vocabulary.h"

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

TEST(WatchView, SetsAFaultASilenceAndALimitApart) {
  WatchModel three = model(4);
  three.joints[1].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
  three.joints[1].view.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  three.joints[2].age_s = 2.5;
  three.joints[3].view.state.notices = static_cast<std::int32_t>(Notice::kTorqueLimited);
  const Screen screen = render(three, 24, 160);
  const auto style = [&](const std::string& name) { return screen.at(row_of(screen, name), 1).style; };
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
  EXPECT_TRUE(shows(screen, "orders are not signed"));
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
  // As long as ack_v1.text may be.
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
  hostile.joints[0].limits.emplace();  // min and max are equal
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

TEST(WatchScreen, KeepsCharactersOfSeveralBytesInOneCell) {
  Screen screen(1, 4);
  EXPECT_EQ(screen.put(0, 1, "a█b█"), 5);
  EXPECT_EQ(screen.text(0), " a█b");
  EXPECT_EQ(screen.at(0, 2).glyph, "█");
  EXPECT_EQ(Screen(-1, -1).rows(), 0);
}

}  // namespace
}  // namespace strainwave
