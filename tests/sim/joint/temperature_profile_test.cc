// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/temperature_profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "tests/support/refusal.h"

namespace strainwave {
namespace {

std::filesystem::path file_with(const std::string& text) {
  const auto path = std::filesystem::path(::testing::TempDir()) /
                    (std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".csv");
  std::ofstream(path) << text;
  return path;
}

std::string refusal(const std::string& text) {
  return testing::refusal_of([&] { TemperatureProfile::parse(text); });
}

TEST(TemperatureProfile, RisesAtEveryWholeIntervalAndThenHolds) {
  const auto profile = TemperatureProfile::parse("steps:-10,5,1,11");
  for (int k = 0; k < 20000; ++k) {
    const double expected_C = -10.0 + 5.0 * std::min(k / 1000, 11);
    ASSERT_EQ(profile.at(static_cast<double>(k) * 1e-3), expected_C) << "sample " << k;
  }
}

TEST(TemperatureProfile, GoesUpARampAndStaysAtItsEnds) {
  const auto profile = TemperatureProfile::parse("ramp:25,-10,2,9");
  EXPECT_EQ(profile.at(0.0), 25.0);
  EXPECT_EQ(profile.at(2.0), 25.0);
  EXPECT_DOUBLE_EQ(profile.at(4.0), 15.0);
  EXPECT_EQ(profile.at(9.0), -10.0);
  EXPECT_EQ(profile.at(1e6), -10.0);
}

TEST(TemperatureProfile, FollowsTheSine) {
  const auto profile = TemperatureProfile::parse("sine:15,25,1");
  EXPECT_DOUBLE_EQ(profile.at(0.0), 15.0);
  EXPECT_DOUBLE_EQ(profile.at(2.0), 15.0 + 25.0 * std::sin(2.0));
}

TEST(TemperatureProfile, InterpolatesARecordAndHoldsItsEnds) {
  const auto path = file_with("# recorded\ntime_s,ambient_temperature_C\n1,10\n3,20\n\n4,0\n");
  const auto profile = TemperatureProfile::parse("csv:" + path.string());
  EXPECT_EQ(profile.at(0.0), 10.0);
  EXPECT_EQ(profile.at(1.5), 12.5);
  EXPECT_EQ(profile.at(3.0), 20.0);
  EXPECT_EQ(profile.at(3.25), 15.0);
  EXPECT_EQ(profile.at(9.0), 0.0);
}

TEST(TemperatureProfile, HoldsEachRowUntilTheNextWhenTold) {
  const auto path = file_with("time_s,ambient_temperature_C\n1,10\n3,20\n");
  const auto profile = TemperatureProfile::parse("hold:" + path.string());
  EXPECT_EQ(profile.at(2.999), 10.0);
  EXPECT_EQ(profile.at(3.0), 20.0);
}

TEST(TemperatureProfile, NamesTheFileAndLineOfABadRecord) {
  const auto refused_at = [](const std::string& text, const std::string& place) {
    const auto path = file_with(text);
    const std::string message = refusal("csv:" + path.string());
    EXPECT_EQ(message.find(path.string() + place), 0U) << message;
    return message;
  };
  EXPECT_NE(refused_at("time,temperature\n1,2\n", ":1:").find("time_s,ambient_temperature_C"),
            std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n0,20\n1,warm\n", ":3:").find("warm"),
            std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n0,20\n1,nan\n", ":3:").find("nan"), std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n0,20\n1,21,22\n", ":3:").find("fields"),
            std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n0,20\n# pause\n0,21\n", ":4:").find("greater"),
            std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n0,-300\n", ":2:").find("-273.15"), std::string::npos);
  EXPECT_NE(refused_at("time_s,ambient_temperature_C\n", ": has no data").find("at least one row"),
            std::string::npos);
  EXPECT_NE(refusal("csv:/nonexistent/profile.csv").find("cannot be read"), std::string::npos);
}

TEST(TemperatureProfile, RefusesTextThatIsNoProfile) {
  for (const char* text :
       {"", "warm", "constant", "constant:", "constant:20,30", "constant:-400", "steps:1,2,3",
        "steps:0,5,0,3", "steps:0,5,1,0", "steps:0,5,1,1.5", "ramp:0,5,1", "ramp:0,5,2,2", "ramp:0,5,2,1",
        "ramp:0,-300,1,2", "sine:15,25", "sine:15,inf,1", "csv:"})
    EXPECT_NE(refusal(text), "accepted") << text;
  EXPECT_EQ(refusal("constant:-10"), "accepted");
}

}  // namespace
}  // namespace strainwave
