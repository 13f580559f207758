// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/flight_record.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "client/commands/commands.h"
#include "client/text/mcap_flight.h"
#include "strainwave/client_error.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr const char* kHead =
    "# strainwave-flight-record 1\n# joint: elbow\n# joint_model: rhs17-6006\n# session_id: 1\n# fault: 13 "
    "speed limit\n"
    "# fault_cycle: 2\n# fault_utc: 2026-11-21T03:04:05Z\n# period_s: 0.001\n# rows: 3\n# lost_rows: 0\n# "
    "units: s,1\n";
constexpr const char* kColumns =
    "cycle,time_s,mode,fault,setpoint_position_rad,setpoint_velocity_rad_s,joint_position_rad,torque_"
    "commanded_Nm,torque_applied_Nm,"
    "temperature_used_C,temperature_measured_C\n";
constexpr const char* kRows =
    "1,-0.001,6,0,0.1,0,0.1,1,1,20,20\n2,0,5,13,0.1,0,0.11,0,1,20,nan\n3,0.001,5,13,0.11,0,0.11,0,0,20,20\n";

class FlightRecordPlot : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text, const std::string& name = "a.flight.csv") {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::string refusal(const std::filesystem::path& path) {
    return testing::refusal_of([&] { read_flight_record(path); });
  }
  TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
};

TEST_F(FlightRecordPlot, ReadsTheHeadAndNumbersTheColumns) {
  const FlightRecordInfo info = read_flight_record(file(std::string(kHead) + kColumns + kRows));
  EXPECT_EQ(info.head.at("joint"), "elbow");
  EXPECT_EQ(info.head.at("fault"), "13 speed limit");
  EXPECT_EQ(info.columns.at("cycle"), 1);
  EXPECT_EQ(info.columns.at("temperature_measured_C"), 11);
  EXPECT_EQ(info.period_s, 0.001);
}

TEST_F(FlightRecordPlot, RefusesWhatIsNoRecordAndSaysWhy) {
  EXPECT_NE(refusal(folder_ / "absent").find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal(folder_).find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal(file("cycle,time_s\n")).find("not a flight record of format 1"), std::string::npos);
  EXPECT_NE(refusal(file("# strainwave-flight-record 2\n")).find("not a flight record of format 1"),
            std::string::npos);
  EXPECT_NE(refusal(file(std::string(kHead) + "cycle,time_s\n")).find("no column mode"), std::string::npos);
  EXPECT_NE(refusal(file(kHead)).find("no column"), std::string::npos);
}

TEST_F(FlightRecordPlot, DrawsWithoutADaemon) {
  std::ostringstream text;
  const Output output{text};
  const auto path = file(std::string(kHead) + kColumns + kRows, "it's a record.flight.csv");
  plot_record(output, {path, std::nullopt, std::nullopt});
  std::ifstream picture(path.string() + ".png", std::ios::binary);
  std::string magic(8, '\0');
  picture.read(magic.data(), 8);
  EXPECT_EQ(magic, "\x89PNG\r\n\x1a\n");
  EXPECT_NE(text.str().find("fault 13 speed limit"), std::string::npos);
  plot_record(output, {path, folder_ / "b.png", 0.0005});
  EXPECT_TRUE(std::filesystem::exists(folder_ / "b.png"));
}

TEST_F(FlightRecordPlot, LetsNoNameInAFileBecomeAnInstruction) {
  std::string head = kHead;
  head.replace(head.find("elbow"), 5, "x'; system('false') #\x1b[2J");
  const FlightRecordInfo info = read_flight_record(file(head + kColumns + kRows));
  const std::string script = plot_script(info, folder_ / "a", folder_ / "b", std::nullopt);
  EXPECT_NE(script.find("'x''; system(''false'') #[2J: fault"), std::string::npos) << script;
}

TEST_F(FlightRecordPlot, DrawsEveryModeInsideItsAxis) {
  const FlightRecordInfo info = read_flight_record(file(std::string(kHead) + kColumns + kRows));
  const std::string script = plot_script(info, folder_ / "a", folder_ / "b", std::nullopt);
  EXPECT_NE(script.find("'releasing' 7)"), std::string::npos) << script;
  EXPECT_NE(script.find("set yrange [-0.5:7.5]"), std::string::npos) << script;
}

TEST_F(FlightRecordPlot, TakesTheErrorAtTheInstantOfThePosition) {
  const FlightRecordInfo info = read_flight_record(file(std::string(kHead) + kColumns + kRows));
  const std::string script = plot_script(info, folder_ / "a", folder_ / "b", std::nullopt);
  EXPECT_NE(script.find("using 2:($5 - 0.001 * $6 - $7)"), std::string::npos) << script;
}

TEST_F(FlightRecordPlot, TurnsNoTimeIntoMcapThatItsNanosecondsCannotHold) {
  for (const char* utc : {"9999-11-21T03:04:05Z", "1969-12-31T23:59:59Z", "2026-11-21T2000000000:04:05Z",
                          "2026-11-21T-3:04:05Z"}) {
    std::string text = std::string(kHead) + kColumns + kRows;
    text.replace(text.find("2026-11-21T03:04:05Z"), 20, utc);
    try {
      write_flight_mcap(file(text), folder_ / "a.mcap");
      ADD_FAILURE() << utc << " was taken";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("fault_utc"), std::string::npos) << error.what();
    }
  }
}

TEST_F(FlightRecordPlot, SaysWhenThePictureCannotBeWritten) {
  std::ostringstream text;
  const auto path = file(std::string(kHead) + kColumns + kRows);
  const std::string refused = testing::refusal_of<std::runtime_error>([&] {
    plot_record({text}, {path, folder_ / "no" / "such" / "b.png", std::nullopt});
  });
  EXPECT_NE(refused.find("b.png"), std::string::npos) << refused;
}

}  // namespace
}  // namespace strainwave
