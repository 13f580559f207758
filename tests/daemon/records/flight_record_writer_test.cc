// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/records/flight_record_writer.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <set>
#include <sstream>

#include "base/text_file.h"
#include "daemon/realtime/loop/periodic_clock.h"
#include "daemon/records/flight_record_file.h"
#include "lcmtypes/reading_doubt.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

namespace fs = std::filesystem;
constexpr std::int64_t kSecond_ns = 1'000'000'000;

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(line);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// The value of a row below a column name.
std::string value_in(const std::string& row, const std::string& names, const char* name) {
  const auto columns = split(names, ',');
  return split(row, ',').at(
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin()));
}

std::vector<std::string> lines_of(const fs::path& path) {
  std::ifstream file(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

class FlightRecordWriterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    config_.directory = temporary_.path() / "records";
    config_.min_interval_s = 0.0;
  }
  void TearDown() override { fs::permissions(temporary_.path(), fs::perms::owner_all); }

  FlightRecordWriter writer() {
    return {config_,
            0.001,
            4711,
            {{"elbow", "rhs17-6006", &elbow_}, {"wrist", "rhs17-6006", &wrist_}},
            [this](bool lost, const std::string& text, std::int64_t /*now_ns*/) {
              (lost ? lost_ : written_).push_back(text);
            }};
  }
  /// Records a fault after `count` good samples.
  void fault(FlightRecorder& recorder, int count = 50, std::uint8_t number = 13) {
    FlightSample sample;
    sample.time_ns = now_ns_;
    for (int i = 0; i < count || !recorder.frozen(); ++i) {
      sample.cycle = ++cycle_;
      sample.time_ns += 1'000'000;
      sample.fault = i < count ? 0 : number;
      sample.joint_position_rad = 0.1 * i;
      recorder.write(sample);
      if (recorder.frozen()) break;
    }
    now_ns_ += 100'000'000;
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> paths;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(config_.directory, error)) paths.push_back(entry.path());
    return paths;
  }
  std::uintmax_t total_size() const {
    std::uintmax_t total = 0;
    for (const fs::path& path : files()) total += fs::file_size(path);
    return total;
  }

  std::vector<std::string> written_;  ///< messages of the writer
  std::vector<std::string> lost_;
  TemporaryFolder temporary_;
  RecorderConfig config_;
  FlightRecorder elbow_{100, 10};
  FlightRecorder wrist_{100, 10};
  std::int64_t now_ns_ = 10 * kSecond_ns;
  std::int64_t cycle_ = 0;
};

TEST_F(FlightRecordWriterTest, WritesTheDocumentedFormat) {
  fault(elbow_);
  writer().turn(now_ns_);
  ASSERT_EQ(files().size(), 1U);
  const std::string name = files().front().filename();
  EXPECT_TRUE(name.starts_with("elbow-")) << name;
  EXPECT_TRUE(name.ends_with("-c51-f13.flight.csv")) << name;
  const auto lines = lines_of(files().front());
  ASSERT_GT(lines.size(), 12U);
  EXPECT_EQ(lines[0], "# strainwave-flight-record 1");
  EXPECT_EQ(lines[1], "# joint: elbow");
  EXPECT_EQ(lines[2], "# joint_model: rhs17-6006");
  EXPECT_EQ(lines[3], "# session_id: 4711");
  EXPECT_EQ(lines[4], "# fault: 13 speed limit");
  EXPECT_EQ(lines[5], "# fault_cycle: 51");
  EXPECT_TRUE(lines[6].starts_with("# fault_utc: 2")) << lines[6];
  EXPECT_EQ(lines[7], "# period_s: 0.001");
  EXPECT_EQ(lines[8], "# rows: 61");
  EXPECT_EQ(lines[9], "# lost_rows: 0");
  EXPECT_TRUE(lines[10].starts_with("# units: s,1,1,rad,")) << lines[10];
  EXPECT_TRUE(lines[11].starts_with("time_s,cycle,table_id,setpoint_position_rad,")) << lines[11];
  EXPECT_EQ(lines.size(), 12U + 61U);
  const auto columns = split(lines[11], ',');
  EXPECT_EQ(split(lines[10].substr(9), ',').size(), columns.size());
  for (std::size_t i = 12; i < lines.size(); ++i)
    ASSERT_EQ(split(lines[i], ',').size(), columns.size()) << lines[i];
  const auto value = [&](const char* column) { return value_in(lines[12 + 50], lines[11], column); };
  EXPECT_EQ(value("cycle"), "51");
  EXPECT_EQ(value("time_s"), "0");
  EXPECT_EQ(value("fault"), "13") << "a byte is printed as a number";
}

TEST_F(FlightRecordWriterTest, NamesTheCauseOfAReadingThatCannotBeTrue) {
  FlightSample sample;
  sample.time_ns = now_ns_;
  elbow_.write(sample);
  sample.fault = static_cast<std::uint8_t>(Fault::kImplausibleReading);
  sample.drive_error = doubt_number(ReadingDoubt::kJump, 0.5);
  while (!elbow_.frozen()) elbow_.write(sample);
  writer().turn(now_ns_);
  ASSERT_EQ(files().size(), 1U);
  const auto lines = lines_of(files().front());
  EXPECT_EQ(lines.at(4), "# fault: 5 " + fault_words(Fault::kImplausibleReading, sample.drive_error));
  EXPECT_NE(lines.at(4).find("the position jumped by"), std::string::npos) << lines.at(4);
  EXPECT_EQ(value_in(lines.back(), lines.at(11), "fault"), "5") << lines.back();
  EXPECT_EQ(value_in(lines.back(), lines.at(11), "drive_error"), std::to_string(sample.drive_error))
      << lines.back();
}

TEST_F(FlightRecordWriterTest, DocumentsEveryColumn) {
  fault(elbow_);
  writer().turn(now_ns_);
  const auto lines = lines_of(files().at(0));
  const auto names = split(lines[11], ',');
  const auto units = split(lines[10].substr(9), ',');
  const std::string page = read_text_file(STRAINWAVE_SOURCE_DIR "/docs/flight-recorder.md");
  for (std::size_t i = 0; i < names.size(); ++i)
    EXPECT_NE(page.find("\n| `" + names[i] + "` | " + units[i] + " |"), std::string::npos) << names[i];
}

TEST_F(FlightRecordWriterTest, ReleasesTheMemoryWhateverBecomesOfTheFile) {
  RecorderConfig nowhere = config_;
  nowhere.directory = "/proc/no/such/place";
  fault(elbow_);
  std::string told;
  FlightRecordWriter(nowhere, 0.001, 4711, {{"elbow", "rhs17-6006", &elbow_}},
                     [&](bool lost, const std::string& text, std::int64_t /*now_ns*/) {
                       if (lost) told = text;
                     })
      .turn(now_ns_);
  EXPECT_NE(told.find("elbow: flight record lost: "), std::string::npos) << told;
  elbow_.write(FlightSample{});
  EXPECT_FALSE(elbow_.frozen());
}

TEST_F(FlightRecordWriterTest, WritesOneJointNoMoreOftenThanTheInterval) {
  config_.min_interval_s = 5.0;
  FlightRecordWriter records = writer();
  for (int i = 0; i < 50; ++i) {
    fault(elbow_);  // 0.1 s later each time
    records.turn(now_ns_);
  }
  EXPECT_EQ(files().size(), 1U);
  fault(wrist_);
  records.turn(now_ns_);
  EXPECT_EQ(files().size(), 2U) << "the interval is a joint's own";
  now_ns_ += 6 * kSecond_ns;
  fault(elbow_);
  records.turn(now_ns_);
  EXPECT_EQ(files().size(), 3U);
}

TEST_F(FlightRecordWriterTest, KeepsTheNumberOfFilesBoundedAndTheNewest) {
  config_.max_files = 4;
  FlightRecordWriter records = writer();
  for (int i = 0; i < 12; ++i) {
    fault(elbow_);
    records.turn(now_ns_);
    EXPECT_LE(files().size(), 4U);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // file times differ
  }
  std::set<std::string> names;
  for (const fs::path& path : files()) names.insert(path.filename());
  EXPECT_EQ(names.size(), 4U);
  const std::string newest_cycle = "-c" + std::to_string(cycle_ - 10) + "-";
  EXPECT_TRUE(std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return name.find(newest_cycle) != std::string::npos;
  })) << newest_cycle;
}

TEST_F(FlightRecordWriterTest, KeepsTheTotalSizeBounded) {
  config_.max_total_MB = 0.02;
  FlightRecordWriter records = writer();
  for (int i = 0; i < 20; ++i) {
    fault(elbow_, 90);
    records.turn(now_ns_);
    EXPECT_LE(total_size(), 20000U);
  }
  EXPECT_GE(files().size(), 1U);
}

TEST_F(FlightRecordWriterTest, TouchesNoFileThatIsNotItsOwn) {
  config_.max_files = 1;
  fs::create_directories(config_.directory);
  std::ofstream(config_.directory / "notes.csv") << "mine";
  FlightRecordWriter records = writer();
  for (int i = 0; i < 3; ++i) {
    fault(elbow_);
    records.turn(now_ns_);
  }
  EXPECT_TRUE(fs::exists(config_.directory / "notes.csv"));
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(FlightRecordWriterTest, RemovesWhatACrashLeftHalfWritten) {
  fs::create_directories(config_.directory);
  std::ofstream(config_.directory / "elbow-x.flight.csv.part") << "half";
  fault(elbow_);
  writer().turn(now_ns_);
  EXPECT_EQ(files().size(), 1U);
  EXPECT_FALSE(files().front().string().ends_with(".part"));
}

TEST_F(FlightRecordWriterTest, SurvivesAFileSizeLimitAndLeavesNothingBehind) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const rlimit tiny{2000, before.rlim_max};
  const auto old_action = ::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tiny), 0);
  fault(elbow_);
  writer().turn(now_ns_);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, old_action);
  EXPECT_TRUE(files().empty()) << "no half record";
}

TEST_F(FlightRecordWriterTest, SurvivesAFullDiskAndWritesAgainWhenThereIsRoom) {
  fs::create_directories(config_.directory);
  if (::mount("tmpfs", config_.directory.c_str(), "tmpfs", 0, "size=16k") != 0)
    GTEST_SKIP() << "no right to mount a file system";
  {
    std::ofstream filler(config_.directory / "filler");
    for (int i = 0; i < 64 && filler.flush(); ++i) filler << std::string(1024, 'x');
  }
  FlightRecordWriter records = writer();
  fault(elbow_);
  records.turn(now_ns_);
  EXPECT_EQ(files().size(), 1U) << "only the filler";
  fs::remove(config_.directory / "filler");
  fault(elbow_);
  records.turn(now_ns_);
  EXPECT_EQ(files().size(), 1U);
  EXPECT_TRUE(files().front().string().ends_with(".flight.csv"));
  ::umount(config_.directory.c_str());
}

TEST_F(FlightRecordWriterTest, WritesFromItsOwnThread) {
  FlightRecordWriter records = writer();
  records.start();
  now_ns_ = monotonic_now_ns();
  fault(elbow_);
  for (int i = 0; i < 1000 && files().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  ASSERT_FALSE(files().empty());
}

}  // namespace
}  // namespace strainwave
