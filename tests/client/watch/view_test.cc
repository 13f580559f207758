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
       {"joint0", "joint1", "holding", "+0.250000", "SW: ", "s stop", "e enable", "sensor"})
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
    EXPECT_EQ(screen.at(row, 0).style, Style::kSelected);
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

TEST(WatchView, OffersNoSignedOrderWithoutAKey) {
  WatchModel unsigned_model = model(1);
  unsigned_model.has_key = false;
  const Screen screen = render(unsigned_model, 24, 160);
  EXPECT_FALSE(shows(screen, "e enable"));
  EXPECT_TRUE(shows(screen, "s stop"));
  EXPECT_TRUE(shows(screen, "--key FILE"));
}

TEST(WatchView, ShowsWhereTheTemperatureComesFrom) {
  WatchModel one = model(1);
  one.joints[0].temperature.emplace();
  one.joints[0].temperature->age_s = 0.3;
  EXPECT_TRUE(shows(render(one, 24, 160), "sensor, 0.3 s"));
  one.joints[0].view.state.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kTooOld);
  EXPECT_TRUE(shows(render(one, 24, 160), "too old"));
}

TEST(WatchView, ASparklineIsScaledToItsLargestValueAndKeepsToAscii) {
  EXPECT_EQ(sparkline({0.0, 0.5, 1.0}, 10, false), ".+#");
  EXPECT_EQ(sparkline({0.0, 0.5, 1.0}, 10, true), "▁▅█");
  EXPECT_EQ(sparkline({5.0, 0.0, 1.0}, 2, false), ".#") << "only what is shown counts";
  EXPECT_EQ(sparkline({0.0, 0.0}, 5, false), "..");
  EXPECT_EQ(sparkline({std::nan(""), 1.0}, 5, false), "?#");
  EXPECT_EQ(sparkline({}, 5, true), "");
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
