// SPDX-License-Identifier: BSD-3-Clause
// PWM and counter on plain files instead of sysfs.
#include <gtest/gtest.h>
#include <sys/inotify.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "base/input_error.h"
#include "base/unique_fd.h"
#include "drivers/gpio/counter_counts.h"
#include "drivers/gpio/pwm_channel.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace strainwave {
namespace {

class SysfsParts : public ::testing::Test {
 protected:
  void write(const std::string& file, const std::string& text) const {
    std::filesystem::create_directories((folder_.path() / file).parent_path());
    std::ofstream(folder_.path() / file) << text;
  }
  /// Reads the first line only. A plain file may keep digits of a longer earlier number in its later lines.
  std::string read(const std::string& file) const {
    std::ifstream stream(folder_.path() / file);
    std::string line;
    std::getline(stream, line);
    return line;
  }
  void make_pwm() const {
    for (const char* name : {"enable", "duty_cycle", "period", "polarity"})
      write(std::string("pwmchip0/pwm2/") + name, "0\n");
  }
  PwmConfig pwm() const { return {folder_.path() / "pwmchip0", 2, 20000.0, false}; }
  CounterConfig counter(std::optional<std::uint64_t> ceiling) const {
    return {folder_.path() / "count0", ceiling, "quadrature x4"};
  }
  TemporaryFolder folder_;
};

TEST_F(SysfsParts, PwmStartsIdleAndFollowsTheDuty) {
  make_pwm();
  PwmChannel channel(pwm(), 0.5, "joint[0].gpio.pwm");
  EXPECT_EQ(read("pwmchip0/pwm2/period"), "50000");
  EXPECT_EQ(read("pwmchip0/pwm2/duty_cycle"), "25000");
  EXPECT_EQ(read("pwmchip0/pwm2/polarity"), "normal");
  EXPECT_EQ(read("pwmchip0/pwm2/enable"), "1");
  for (const auto& [duty, text] :
       {std::pair{0.25, "12500"}, {0.0, "0"}, {1.0, "50000"}, {1.5, "50000"}, {-0.5, "0"}}) {
    EXPECT_TRUE(channel.set_duty(duty));
    EXPECT_EQ(read("pwmchip0/pwm2/duty_cycle"), text);
  }
}

// Linux 6.1 refuses any change of a channel that has no period yet. A plain file refuses nothing, so the test checks the order of the writes.
TEST_F(SysfsParts, PwmThatIsOffIsWrittenItsPeriodBeforeAnythingElse) {
  make_pwm();
  const UniqueFd watch(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
  ASSERT_TRUE(watch);
  ASSERT_GE(::inotify_add_watch(watch.get(), (folder_.path() / "pwmchip0/pwm2").c_str(), IN_MODIFY), 0);
  const PwmChannel channel(pwm(), 0.5, "pwm");
  alignas(inotify_event) std::array<char, 4096> events{};
  ASSERT_GT(::read(watch.get(), events.data(), events.size()), 0);
  inotify_event first{};
  std::memcpy(&first, events.data(), sizeof first);
  EXPECT_STREQ(events.data() + sizeof first, "period");
}

TEST_F(SysfsParts, PwmThatSomebodyLeftOnIsSwitchedOffFirst) {
  make_pwm();
  write("pwmchip0/pwm2/enable", "1\n");
  const UniqueFd watch(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC));
  ASSERT_GE(::inotify_add_watch(watch.get(), (folder_.path() / "pwmchip0/pwm2").c_str(), IN_MODIFY), 0);
  const PwmChannel channel(pwm(), 0.5, "pwm");
  alignas(inotify_event) std::array<char, 4096> events{};
  ASSERT_GT(::read(watch.get(), events.data(), events.size()), 0);
  EXPECT_STREQ(events.data() + sizeof(inotify_event), "enable");
}

TEST_F(SysfsParts, PwmIsIdleAtTheEnd) {
  make_pwm();
  {
    PwmChannel channel(pwm(), 0.5, "pwm");
    ASSERT_TRUE(channel.set_duty(0.9));
  }
  EXPECT_EQ(read("pwmchip0/pwm2/duty_cycle"), "25000");
  EXPECT_EQ(read("pwmchip0/pwm2/enable"), "1") << "an output that is off has a level of its own";
}

TEST_F(SysfsParts, PwmThatDoesNotExistIsNamed) {
  const std::string refused =
      testing::refusal_of([&] { const PwmChannel channel(pwm(), 0.0, "joint[0].gpio.pwm"); });
  EXPECT_NE(refused.find("joint[0].gpio.pwm"), std::string::npos);
  EXPECT_NE(refused.find("pwmchip0"), std::string::npos);
}

TEST_F(SysfsParts, CounterIsSetUpAndCountsFromWhereItStands) {
  for (const char* name : {"count", "ceiling", "function", "enable"})
    write(std::string("count0/") + name, "0\n");
  write("count0/count", "700\n");
  CounterCounts counts(counter(999), "joint[0].gpio.encoder");
  EXPECT_EQ(read("count0/ceiling"), "999");
  EXPECT_EQ(read("count0/function"), "quadrature x4");
  EXPECT_EQ(read("count0/enable"), "1");
  EXPECT_EQ(counts.read(0).counts, 0);
  write("count0/count", "720\n");
  EXPECT_EQ(counts.read(0).counts, 20);
  EXPECT_EQ(counts.read(0).state, CountSource::State::kFresh);
}

TEST_F(SysfsParts, CounterThatShowsNoNumberIsStaleAndOneAboveItsCeilingImplausible) {
  write("count0/count", "10\n");
  write("count0/ceiling", "0\n");
  CounterCounts counts(counter(999), "encoder");
  (void)counts.read(0);
  for (const char* text : {"", "abc\n", "-1\n", "12x\n", "99999999999999999999999\n"}) {
    write("count0/count", text);
    EXPECT_EQ(counts.read(0).state, CountSource::State::kStale) << text;
  }
  write("count0/count", "1000\n");
  EXPECT_EQ(counts.read(0).state, CountSource::State::kImplausible);
  write("count0/count", "12\n");
  EXPECT_EQ(counts.read(0).state, CountSource::State::kImplausible) << "until cleared";
  counts.clear_fault();
  EXPECT_EQ(counts.read(0).state, CountSource::State::kFresh);
  EXPECT_EQ(counts.read(0).counts, 2);
}

TEST_F(SysfsParts, CounterWithoutARangeIsRefused) {
  write("count0/count", "0\n");
  write("count0/ceiling", "0\n");
  EXPECT_THROW(CounterCounts(counter(std::nullopt), "encoder"), InputError);
  EXPECT_THROW(CounterCounts({folder_.path() / "count9", std::nullopt, ""}, "encoder"), InputError);
}

TEST(CountUnwrapper, GoesTheShorterWayRoundInAnyRange) {
  std::mt19937_64 random(5);
  __extension__ using Wide = __int128;
  for (const std::uint64_t ceiling : {std::uint64_t{6399}, std::uint64_t{65535}, std::uint64_t{0xFFFFFFFF},
                                      std::numeric_limits<std::uint64_t>::max()}) {
    CountUnwrapper unwrapper(ceiling);
    const std::int64_t furthest =
        static_cast<std::int64_t>(std::min<std::uint64_t>(ceiling / 2 - 1, 1'000'000'000));
    std::uniform_int_distribution<std::int64_t> step(-furthest, furthest);
    std::int64_t truth = 0;
    std::uint64_t shown = ceiling / 3;
    ASSERT_EQ(unwrapper.step(shown), 0);
    for (int i = 0; i < 1000; ++i) {
      const std::int64_t by = step(random);
      truth += by;
      // Adds modulo ceiling + 1 in 128 bits.
      const Wide modulus = static_cast<Wide>(ceiling) + 1;
      const Wide moved = static_cast<Wide>(shown) + modulus + by;
      shown = static_cast<std::uint64_t>(moved % modulus);
      ASSERT_EQ(unwrapper.step(shown), truth) << ceiling;
    }
  }
}

}  // namespace
}  // namespace strainwave
