// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "strainwave/client_error.h"
#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

std::string refusal(std::string_view text) {
  try {
    parse_position_rad(text);
  } catch (const ClientError& error) {
    EXPECT_EQ(error.status(), ExitStatus::kUsage);
    return error.what();
  }
  return "";
}

JointView healthy() {
  JointView view;
  view.state.mode = static_cast<std::int32_t>(Mode::kHolding);
  view.state.rule_count = 5;
  return view;
}

TEST(Wrapped, BreaksAtBlanksKeepsEveryWordAndSaysWhatItLeavesOut) {
  EXPECT_EQ(wrapped("one two three", 7, 9), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("one two three", 8, 9), (std::vector<std::string>{"one two", "three"}));
  EXPECT_EQ(wrapped("unbreakable", 5, 9), (std::vector<std::string>{"unbre", "akabl", "e"}));
  EXPECT_EQ(wrapped("one two three four", 7, 2), (std::vector<std::string>{"one two", "thre..."}));
  EXPECT_EQ(wrapped("", 7, 2), std::vector<std::string>{""});
}

TEST(Position, IsReadAsAPlainDecimalNumber) {
  EXPECT_EQ(parse_position_rad("0.1"), 0.1);
  EXPECT_EQ(parse_position_rad("+0.1"), 0.1);
  EXPECT_EQ(parse_position_rad("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parse_position_rad("-.5"), -0.5);
  EXPECT_EQ(parse_position_rad("7"), 7.0);
}

TEST(Position, InDegreesIsAnsweredWithTheSameAngleInRad) {
  for (const char* text : {"90deg", "90 deg", "90 degrees", "90d", "90\xC2\xB0"}) {
    EXPECT_NE(refusal(text).find("1.5708 rad"), std::string::npos) << text << ": " << refusal(text);
  }
}

TEST(Position, ThatIsNoNumberIsRefusedByName) {
  for (const char* text :
       {"", " ", "abc", "nan", "inf", "-inf", "1e999", "1,5", "0x10", "1 2", "--1", "++1", "1rad"}) {
    EXPECT_NE(refusal(text).find(std::string("'") + text + "'"), std::string::npos) << text;
  }
}

TEST(Clipped, NeverCutsACharacterInTwo) {
  EXPECT_EQ(clipped("abcdef", 3), "abc");
  EXPECT_EQ(clipped("ab", 3), "ab");
  EXPECT_EQ(clipped("a\xC2\xB0"
                    "bc",
                    2),
            "a\xC2\xB0");
  EXPECT_EQ(clipped("abc", 0), "");
}

TEST(StateRow, ShowsWhatIsWantedWhatIsAndTheDifference) {
  JointView view = healthy();
  view.state.setpoint_position_rad = 0.1;
  view.state.joint_position_rad = 0.100002;
  view.state.torque_commanded_Nm = -3.25;
  view.state.temperature_used_C = -10.0;
  const std::string row = state_row("elbow", 12, view, 0.0);
  for (const char* part : {"elbow", "holding", "+0.100000", "+0.100002", "-2.0e-06", "-3.250", "-10.0"}) {
    EXPECT_NE(row.find(part), std::string::npos) << part << " in " << row;
  }
}

TEST(StateRow, ShowsNoNegativeZero) {
  JointView view = healthy();
  view.state.setpoint_position_rad = -0.0;
  view.state.joint_position_rad = -4e-7;
  view.state.torque_commanded_Nm = -4e-4;
  view.state.torque_applied_Nm = -0.0;
  view.state.temperature_used_C = -0.04;
  view.state.target_position_rad = -0.0;
  const std::string row = state_row("elbow", 12, view, 0.0);
  EXPECT_EQ(row.find("-0.0"), std::string::npos) << row;
  const std::string details = state_details("elbow", view, 0.0);  // all digits, but no sign for zero
  EXPECT_EQ(details.find(" -0\n"), std::string::npos) << details;
  EXPECT_NE(details.find("-0.0004"), std::string::npos) << details;
  view.state = healthy().state;
  view.state.setpoint_position_rad = -0.0;
  EXPECT_NE(state_row("elbow", 12, view, 0.0).find("+0.0e+00"), std::string::npos);
}

TEST(NegativeZero, IsPlainAndAllElseIsKept) {
  for (const double nothing : {-0.0, 0.0, -0.04, 0.04})
    EXPECT_FALSE(std::signbit(without_negative_zero(nothing, 1))) << nothing;
  for (const double something : {-0.06, -0.1, 0.06, -30.0})
    EXPECT_EQ(without_negative_zero(something, 1), something);
  EXPECT_TRUE(std::isnan(without_negative_zero(std::numeric_limits<double>::quiet_NaN(), 1)));
  EXPECT_EQ(temperature_text(-0.04), "+0.0");
  EXPECT_EQ(temperature_text(-0.06), "-0.1");
}

TEST(StateRow, ShowsNoNumberForATemperatureThatWasNeverSeen) {
  JointView view = healthy();
  view.state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  view.state.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kNeverSeen);
  const std::string row = state_row("elbow", 12, view, 0.0);
  EXPECT_EQ(row.find("nan"), std::string::npos) << row;
  EXPECT_NE(row.find("   -\n  temperature never seen"), std::string::npos) << row;
  const std::string details = state_details("elbow", view, 0.0);
  EXPECT_NE(details.find("nan (no plausible value yet)"), std::string::npos) << details;
}

TEST(StateRow, StandsUnderItsHeader) {
  const std::string header = state_header(12);
  const std::string row = state_row("elbow", 12, healthy(), 0.0);
  EXPECT_EQ(header.find("mode"), row.find("holding"));
  EXPECT_EQ(header.size(), row.size());
}

TEST(StateRow, FitsIntoATerminalOf80ColumnsWithItsNotesBelow) {
  JointView view = healthy();
  view.state.mode = static_cast<std::int32_t>(Mode::kReleasing);
  view.state.setpoint_position_rad = -123.456789;
  view.state.joint_position_rad = 3.14159265;
  view.state.torque_commanded_Nm = -123.456;
  view.state.temperature_used_C = -10.25;
  view.state.fault = static_cast<std::int32_t>(Fault::kGroup);
  view.state.notices = (1 << 19) - 1;
  const std::size_t columns = name_columns({{"SW", "elbow"}, {"SW", "shoulder_pitch_3"}});
  std::istringstream lines(state_header(columns) + "\n" + state_row("shoulder_pitch_3", columns, view, 2.5));
  std::string line, text;
  for (int i = 0; std::getline(lines, line); ++i) {
    EXPECT_LE(line.size(), 80U) << line;
    if (i < 2) {
      EXPECT_EQ(line.size(), 16U + 63U) << line;
      continue;
    }
    EXPECT_TRUE(line.starts_with("  ")) << line;
    text += line.substr(1);
  }
  EXPECT_EQ(text, " " + state_notes(view, 2.5)) << "nothing of the notes is lost";
}

TEST(StateNotes, AreEmptyWhenAllIsWell) {
  EXPECT_EQ(state_notes(healthy(), 0.01), "");
}

TEST(StateNotes, NameFaultLimitsSilenceAndASecondDaemon) {
  JointView view = healthy();
  view.state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  view.state.notices = static_cast<std::int32_t>(Notice::kTorqueLimited);
  view.state.temperature_status = static_cast<std::int32_t>(TemperatureStatus::kTooOld);
  view.state.rule_count = 0;
  view.two_daemons = true;
  const std::string notes = state_notes(view, 2.5);
  for (const char* part : {"fault 14: following error", "torque limited", "too old", "no message for 2.5 s",
                           "two daemons", "no table"}) {
    EXPECT_NE(notes.find(part), std::string::npos) << part << " in " << notes;
  }
}

TEST(StateNotes, NameTheFactorWhereFrictionDiffersFromTheTable) {
  JointView view = healthy();
  view.state.notices = static_cast<std::int32_t>(Notice::kFrictionDiffers);
  view.state.friction_factor = 1.625;
  EXPECT_EQ(state_notes(view, 0.01), "friction differs from the table (1.62 times)");
}

TEST(StateNotes, NameTorqueAndMarginOfAHotJoint) {
  JointView view = healthy();
  view.state.notices = static_cast<std::int32_t>(Notice::kDerated);
  view.state.torque_limit_Nm = 12.25;
  view.state.temperature_margin_C = 3.6;
  EXPECT_EQ(state_notes(view, 0.01), "torque derated (12.2 N.m, 3.6 degC below the limit)");
  view.state.temperature_margin_C = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(state_notes(view, 0.01), "torque derated (12.2 N.m, temperature lost)");
}

TEST(StateDetails, NameEveryCodeInWords) {
  JointView view = healthy();
  view.state.fault = static_cast<std::int32_t>(Fault::kSpeedLimit);
  const std::string details = state_details("elbow", view, 0.0);
  EXPECT_NE(details.find("2 (holding)"), std::string::npos) << details;
  EXPECT_NE(details.find("13 (speed limit)"), std::string::npos) << details;
}

TEST(StateDetails, SurviveNumbersThatMeanNothing) {
  JointView view = healthy();
  view.state.mode = 4711;
  view.state.fault = -1;
  view.state.rule_count = 1'000'000;
  view.state.notices = -1;
  EXPECT_NE(state_details("elbow", view, 0.0).find("4711 (unknown)"), std::string::npos);
  view.state.rule_count = -5;
  EXPECT_FALSE(state_details("elbow", view, 0.0).empty());
}

}  // namespace
}  // namespace strainwave
