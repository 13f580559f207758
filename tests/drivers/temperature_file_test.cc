// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/temperature_file.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <thread>

#include "base/input_error.h"
#include "tests/support/allocation_trap.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

constexpr const char* kGoodOneWire =
    "72 01 4b 46 7f ff 0e 10 57 : crc=57 YES\n72 01 4b 46 7f ff 0e 10 57 t=23125\n";

std::atomic<std::int64_t> now_ns{1'000'000'000};
std::int64_t virtual_clock() noexcept {
  return now_ns.load();
}

/// Waits for the other thread, for at most about 20 s, so that a test cannot hang.
bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 20000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

TEST(TemperatureText, IsOneWholeNumberOrNothing) {
  const auto parse = [](std::string_view text) {
    return parse_temperature(TemperatureFileKind::kNumber, text);
  };
  EXPECT_EQ(parse("23125\n"), 23125.0);
  EXPECT_EQ(parse("-5062\n"), -5062.0);
  EXPECT_EQ(parse(" 25.5 \n"), 25.5);
  for (const char* text : {"", "\n", "abc", "12 13", "12abc", "nan", "inf", "1e999", "0x10", "--1"})
    EXPECT_FALSE(parse(text)) << '"' << text << '"';
}

TEST(TemperatureText, OfAOneWireSensorNeedsTheChecksumsYes) {
  const auto parse = [](std::string_view text) {
    return parse_temperature(TemperatureFileKind::kOneWire, text);
  };
  EXPECT_EQ(parse(kGoodOneWire), 23125.0);
  EXPECT_EQ(parse("ff : crc=57 YES\nff t=-1250\n"), -1250.0);
  EXPECT_FALSE(parse("ff : crc=57 NO\nff t=23125\n"));
  EXPECT_FALSE(parse("ff : crc=57 YES\nff 23125\n"));
  EXPECT_FALSE(parse("ff : crc=57 YES t=23125"));
  EXPECT_FALSE(parse("23125\n"));
  EXPECT_FALSE(parse(""));
}

class TemperatureFileTest : public ::testing::Test {
 protected:
  TemperatureFileTest() {
    config_ = {
        folder_.path() / "temp1_input", TemperatureFileKind::kNumber, 0.001, 0.0, 0.001, &virtual_clock};
  }
  // Replaces the file in one step, so that the thread never reads a partial file.
  void write(const std::string& text) const {
    const std::filesystem::path next = folder_.path() / "next";
    std::ofstream(next) << text;
    std::filesystem::rename(next, config_.file);
  }

  TemporaryFolder folder_;
  TemperatureFileConfig config_;
};

TEST_F(TemperatureFileTest, BringsTheNewestValueWithTheTimeItsReadBegan) {
  now_ns = 5'000'000'000;
  write("23125\n");
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.newest().valid; }));
  EXPECT_DOUBLE_EQ(file.newest().temperature_C, 23.125);
  EXPECT_EQ(file.newest().produced_ns, 5'000'000'000);
  now_ns = 6'000'000'000;
  write("-4000\n");
  ASSERT_TRUE(eventually([&] { return file.newest().temperature_C < 0.0; }));
  EXPECT_DOUBLE_EQ(file.newest().temperature_C, -4.0);
  EXPECT_EQ(file.newest().produced_ns, 6'000'000'000);
  EXPECT_EQ(file.errors(), 0);
}

TEST_F(TemperatureFileTest, ScalesAndOffsetsWhatTheSensorShows) {
  write("1000\n");
  config_.scale_C = 0.0625;
  config_.offset_C = -40.0;
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.newest().valid; }));
  EXPECT_DOUBLE_EQ(file.newest().temperature_C, 22.5);
}

TEST_F(TemperatureFileTest, CountsWhatItCannotReadAndKeepsTheLastValueWithItsAge) {
  now_ns = 1'000'000'000;
  write("20000\n");
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.newest().valid; }));
  std::filesystem::remove(config_.file);
  ASSERT_TRUE(eventually([&] { return file.errors() > 2; }));
  now_ns = 9'000'000'000;
  write("broken\n");
  const std::int64_t errors = file.errors();
  ASSERT_TRUE(eventually([&] { return file.errors() > errors + 2; }));
  EXPECT_DOUBLE_EQ(file.newest().temperature_C, 20.0);
  EXPECT_LT(file.newest().produced_ns, 9'000'000'000) << "an old value must not look new";
  write("21000\n");
  ASSERT_TRUE(eventually([&] { return file.newest().temperature_C == 21.0; }))
      << "a sensor that returns is read again";
  EXPECT_EQ(file.newest().produced_ns, 9'000'000'000);
}

TEST_F(TemperatureFileTest, HasNoValueUntilTheFirstGoodOne) {
  write("\n");
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.errors() > 0; }));
  EXPECT_FALSE(file.newest().valid);
}

TEST_F(TemperatureFileTest, TakesThePowerOnValueOfAOneWireSensorForATemperatureOnlyWhenItWasThatHot) {
  config_.kind = TemperatureFileKind::kOneWire;
  write("ff : crc=57 YES\nff t=85000\n");
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.errors() > 0; }));
  EXPECT_FALSE(file.newest().valid);
  write("ff : crc=57 YES\nff t=84500\n");
  ASSERT_TRUE(eventually([&] { return file.newest().temperature_C == 84.5; }));
  write("ff : crc=57 YES\nff t=85000\n");
  EXPECT_TRUE(eventually([&] { return file.newest().temperature_C == 85.0; }));
}

TEST_F(TemperatureFileTest, RefusesAFileThatIsNotThereAndSaysWhich) {
  const std::string refused = testing::refusal_of([&] { const TemperatureFile file(config_); });
  EXPECT_NE(refused.find(config_.file.string()), std::string::npos) << refused;
}

TEST_F(TemperatureFileTest, RefusesImpossibleNumbers) {
  write("1\n");
  for (double TemperatureFileConfig::*key :
       {&TemperatureFileConfig::scale_C, &TemperatureFileConfig::period_s}) {
    for (const double value : {0.0, std::nan("")}) {
      TemperatureFileConfig bad = config_;
      bad.*key = value;
      EXPECT_THROW(TemperatureFile{bad}, InputError);
    }
  }
}

TEST_F(TemperatureFileTest, NeverShowsHalfAValueNorAllocatesInTheLoop) {
  // The test writes n degC at n seconds, so that value and time must match.
  now_ns = 1'000'000'000;
  write("1000\n");
  config_.period_s = 1e-6;
  TemperatureFile file(config_);
  ASSERT_TRUE(eventually([&] { return file.newest().valid; }));
  for (int value = 1; value <= 40; ++value) {
    write(std::to_string(value * 1000) + "\n");
    ASSERT_TRUE(eventually([&] { return file.newest().temperature_C == value; }));
    now_ns = value * 1'000'000'000LL;
    ASSERT_TRUE(eventually([&] {
      const AllocationTrap trap;
      const TemperatureFile::Sample sample = file.newest();
      const std::int64_t touches = trap.touches();
      EXPECT_EQ(touches, 0);
      EXPECT_EQ(sample.temperature_C, value);
      return sample.produced_ns == now_ns;
    }));
  }
}

}  // namespace
}  // namespace strainwave
