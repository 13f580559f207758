// SPDX-License-Identifier: BSD-3-Clause
// Screens of watch for a working robot, in common sizes and on common terminals. The test writes them as text and as pictures to
// build/PRESET/watch_pictures for inspection, and checks what every screen must show.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <tuple>

#include "client/watch/view.h"
#include "strainwave/vocabulary.h"
#include "tests/client/watch/screen_picture.h"

namespace strainwave {
namespace {

using testing::colours_of;
using testing::contrast;
using testing::Theme;

/// A joint that moves back and forth, with noise in its error.
WatchedJoint moving(const std::string& name, double phase) {
  WatchedJoint joint;
  joint.prefix = "SW";
  joint.joint = name;
  joint.age_s = 0.02;
  joint.limits = limits_v1{};
  joint.limits->position_min_rad = -3.2;
  joint.limits->position_max_rad = 3.2;
  joint.limits->torque_limit_Nm = 34.0;
  joint.limits->period_s = 1e-3;
  joint.limits->following_error_rad = 0.1;
  for (int i = 0; i < 600; ++i) {
    const double angle = phase + 0.05 * i;
    joint.history.position_rad.push_back(0.5 * std::sin(angle));
    joint.history.error_rad.push_back(2e-4 * std::cos(angle) + 2e-5 * std::sin(7.3 * i));
    joint.history.torque_Nm.push_back(-6.0 * std::sin(angle));
    joint.history.temperature_C.push_back(20.0 + 0.01 * i);
  }
  state_v1& state = joint.view.state;
  state.mode = static_cast<std::int32_t>(Mode::kTracking);
  state.rule_count = 5;
  state.temperature_weights[2] = 0.4;
  state.temperature_weights[3] = 0.6;
  state.joint_position_rad = joint.history.position_rad.back();
  state.setpoint_position_rad = state.joint_position_rad + joint.history.error_rad.back();
  state.torque_applied_Nm = joint.history.torque_Nm.back();
  state.temperature_used_C = joint.history.temperature_C.back();
  return joint;
}

/// Six joints: one torque-limited, one off. The selected first joint works or has a fault.
WatchModel robot(bool fault_selected) {
  WatchModel model;
  model.daemons.push_back({"SW", {}, 0.3});
  for (const char* name : {"base", "shoulder", "elbow", "wrist_1", "wrist_2", "tool"})
    model.joints.push_back(moving(name, static_cast<double>(model.joints.size())));
  model.joints[2].view.state.notices = static_cast<std::int32_t>(Notice::kTorqueLimited);
  model.joints[5].view.state.mode = static_cast<std::int32_t>(Mode::kOff);
  model.has_key = true;
  if (fault_selected) {
    model.joints[0].view.state.mode = static_cast<std::int32_t>(Mode::kFaulted);
    model.joints[0].view.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
    model.message = "base: enable refused (16, joint is faulted): clear the fault first";
    model.message_alarm = true;
    model.refusals.push_back({model.message, 4.0});
  }
  return model;
}

using Size = std::pair<int, int>;
class WatchPicture : public ::testing::TestWithParam<std::tuple<Size, Theme, bool>> {
 protected:
  WatchPicture() : model_(robot(std::get<2>(GetParam()))), theme_(std::get<1>(GetParam())) {}

  Screen screen() const {
    const auto [columns, rows] = std::get<0>(GetParam());
    return render(model_, rows, columns);
  }

  WatchModel model_;
  Theme theme_;
};

std::string name_of_picture(const ::testing::TestParamInfo<WatchPicture::ParamType>& info) {
  const auto& [size, theme, fault] = info.param;
  return std::to_string(size.first) + "x" + std::to_string(size.second) +
         (theme == Theme::kDark ? "_dark" : "_light") + (fault ? "_fault" : "");
}

TEST_P(WatchPicture, IsDrawn) {
  const std::filesystem::path folder = std::filesystem::path(STRAINWAVE_BINARY_DIR) / "watch_pictures";
  std::filesystem::create_directories(folder);
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::string test = info->name();
  const std::string name = test.substr(test.find('/') + 1);
  const Screen drawn = screen();
  std::ofstream(folder / (name + ".svg")) << testing::picture_of(drawn, theme_);
  std::ofstream text(folder / (name + ".txt"));
  for (int row = 0; row < drawn.rows(); ++row) text << drawn.text(row) << '\n';
  EXPECT_TRUE(text.good());
}

TEST_P(WatchPicture, CanBeReadOnItsTerminal) {
  const Screen drawn = screen();
  for (int row = 0; row < drawn.rows(); ++row)
    for (int column = 0; column < drawn.columns(); ++column) {
      const auto colours = colours_of(drawn.at(row, column), theme_);
      ASSERT_GE(contrast(colours.foreground, colours.background), 4.5) << row << ", " << column;
    }
}

TEST_P(WatchPicture, ShowsErrorTorqueAndTemperatureOfEveryJoint) {
  const Screen drawn = screen();
  for (const WatchedJoint& joint : model_.joints) {
    int row = 1;  // below the title, which names the faulted joint
    while (row < drawn.rows() && drawn.text(row).find(joint.joint + " ") == std::string::npos) ++row;
    ASSERT_LT(row, drawn.rows()) << joint.joint;
    const std::string line = drawn.text(row);
    char temperature[16];
    std::snprintf(temperature, sizeof temperature, "%+.1f", joint.view.state.temperature_used_C);
    char torque[16];
    std::snprintf(torque, sizeof torque, "%+.3f", joint.view.state.torque_applied_Nm);
    EXPECT_NE(line.find(temperature), std::string::npos) << line;
    EXPECT_NE(line.find(std::string(torque).substr(0, 4)), std::string::npos) << line;
    EXPECT_NE(line.find("e-0"), std::string::npos) << line;
  }
}

TEST_P(WatchPicture, ASelectedFaultStandsOut) {
  if (!std::get<2>(GetParam())) return;  // no fault is selected
  const Screen drawn = screen();
  int row = 0;
  while (drawn.text(row).find(">base") == std::string::npos) ++row;
  const Cell& cell = drawn.at(row, 1);
  EXPECT_EQ(cell.style, Style::kAlarm);
  EXPECT_TRUE(cell.marked);
  const auto plain = colours_of({" ", Style::kPlain, true}, theme_);
  const auto alarm = colours_of(cell, theme_);
  EXPECT_NE(std::pair(plain.foreground, plain.background), std::pair(alarm.foreground, alarm.background));
}

TEST_P(WatchPicture, HasNoNegativeZero) {
  WatchedJoint& joint = model_.joints.front();
  state_v1& state = joint.view.state;
  state.joint_position_rad = state.setpoint_position_rad = state.joint_velocity_rad_s = -1e-8;
  state.torque_applied_Nm = state.target_position_rad = -0.0;
  state.temperature_used_C = -0.04;
  joint.limits->position_min_rad = -1e-5;
  joint.history.error_rad = {-0.0};
  joint.history.torque_Nm = {-0.001, 10.0};
  joint.history.temperature_C = {-0.04, 10.0};
  joint.history.position_rad = {-1e-6, 1.0};
  const Screen drawn = screen();
  for (int row = 0; row < drawn.rows(); ++row) {
    const std::string text = drawn.text(row) + " ";
    const auto zero = text.find("-0.0");
    EXPECT_TRUE(zero == text.npos || text.find_first_of("123456789e", zero) < text.find(' ', zero)) << text;
  }
}

TEST_P(WatchPicture, UsesItsRoom) {
  const Screen drawn = screen();
  int empty = 0;
  for (int row = 0; row < drawn.rows(); ++row) empty += drawn.text(row).empty() ? 1 : 0;
  EXPECT_LE(empty, drawn.rows() / 6);
}

INSTANTIATE_TEST_SUITE_P(Sizes, WatchPicture,
                         ::testing::Combine(::testing::Values(Size{80, 24}, Size{120, 40}, Size{200, 50}),
                                            ::testing::Values(Theme::kLight, Theme::kDark),
                                            ::testing::Bool()),
                         name_of_picture);

}  // namespace
}  // namespace strainwave
