// SPDX-License-Identifier: BSD-3-Clause
#include "telemetry/fleet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>
#include <set>
#include <sstream>

#include "base/text_file.h"
#include "lcmtypes/timing_buckets.h"
#include "strainwave/vocabulary.h"

namespace strainwave {
namespace {

constexpr double kNow_s = 1000.0;

const ChannelName kElbow{"SW", "elbow", "STATE"};

limits_v1 limits() {
  limits_v1 limits{};
  limits.period_s = 0.001;
  limits.speed_limit_rad_s = 6.0;
  limits.torque_limit_Nm = 34.0;
  return limits;
}

std::string page_of(const Fleet& fleet, double now_s = kNow_s) {
  Exposition page;
  expose_joints(page, fleet.joints(), now_s);
  expose_daemons(page, fleet.daemons());
  return std::move(page).text();
}

/// Returns the value of the sample with this `name`, or NaN.
double sample(const std::string& page, const std::string& name) {
  const std::size_t found = page.find("\n" + name + " ");
  return found == std::string::npos ? std::nan("") : std::stod(page.substr(found + name.size() + 2));
}

TEST(JointMetrics, KeepThePeaksBetweenTwoScrapes) {
  Fleet fleet;
  state_v1 state{};
  fleet.take(kElbow, state, kNow_s);
  fleet.take(kElbow, limits(), kNow_s);
  state.setpoint_position_rad = 1.0;
  state.setpoint_velocity_rad_s = 2.0;
  state.joint_position_rad = 1.0 + 0.25;
  state.torque_commanded_Nm = -30.0;
  fleet.take(kElbow, state, kNow_s + 1.0);
  fleet.take(kElbow, state_v1{}, kNow_s + 2.0);
  const std::string page = page_of(fleet, kNow_s + 15.0);
  EXPECT_NEAR(sample(page, R"(strainwave_joint_tracking_error_peak_radians{prefix="SW",joint="elbow"})"),
              0.25, 1e-12);
  EXPECT_EQ(sample(page, R"(strainwave_joint_torque_peak_newton_meters{prefix="SW",joint="elbow"})"), 30.0);
  EXPECT_EQ(sample(page, R"(strainwave_joint_torque_newton_meters{prefix="SW",joint="elbow"})"), 0.0);
}

TEST(JointMetrics, SayNothingOfWhatIsNotKnown) {
  Fleet fleet;
  state_v1 state{};
  state.friction_age_s = -1.0;
  state.temperature_used_C = std::numeric_limits<double>::quiet_NaN();
  fleet.take(kElbow, state, kNow_s);
  const std::string page = page_of(fleet);
  for (const char* name : {"friction_age", "torque_limit", "temperature_celsius", "temperature_used_celsius",
                           "joint_fault{", "notice"})
    EXPECT_EQ(page.find(name), std::string::npos) << name;
}

TEST(JointMetrics, NameFaultAndNoticesWhileTheyLast) {
  Fleet fleet;
  state_v1 state{};
  state.fault = static_cast<std::int32_t>(Fault::kFollowingError);
  state.notices = static_cast<std::int32_t>(Notice::kOffStream) |
                  static_cast<std::int32_t>(Notice::kTorqueLimited) | (1 << 30) | (1 << 29);
  fleet.take(kElbow, state, kNow_s);
  const std::string page = page_of(fleet);
  EXPECT_EQ(sample(page, R"(strainwave_joint_fault{prefix="SW",joint="elbow",fault="following error"})"),
            1.0);
  EXPECT_EQ(sample(page, R"(strainwave_joint_notice{prefix="SW",joint="elbow",notice="off the stream"})"),
            1.0);
  EXPECT_EQ(sample(page, R"(strainwave_joint_notice{prefix="SW",joint="elbow",notice="torque limited"})"),
            1.0);
  EXPECT_EQ(page.find("unknown"), std::string::npos) << "bits without a meaning";
}

TEST(JointMetrics, ExplainTheNumbersOfModesAsTheVocabularyDoes) {
  Fleet fleet;
  fleet.take(kElbow, state_v1{}, kNow_s);
  const std::string page = page_of(fleet);
  for (int mode = 0; to_text(static_cast<Mode>(mode)) != "unknown"; ++mode)
    EXPECT_NE(page.find(std::to_string(mode) + " " + std::string(to_text(static_cast<Mode>(mode)))),
              std::string::npos)
        << mode;
}

TEST(DaemonMetrics, HaveHistogramsThatOnlyRiseAndCountEverything) {
  Fleet fleet;
  timing_v1 timing{};
  std::int64_t all = 0;
  for (int i = 0; i < 64; ++i) all += timing.wakeup_latency_count[i] = i + 1;
  fleet.take({"SW", "", "TIMING"}, timing, kNow_s);
  const std::string page = page_of(fleet);
  const std::regex bucket(
      R"re(strainwave_wakeup_latency_seconds_bucket\{prefix="SW",le="([^"]*)"\} (\d+))re");
  double bound_before_s = 0.0;
  double count_before = 0.0;
  int buckets = 0;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), bucket); it != std::sregex_iterator();
       ++it, ++buckets) {
    const double bound_s = (*it)[1] == "+Inf" ? HUGE_VAL : std::stod((*it)[1]);
    EXPECT_GT(bound_s, bound_before_s);
    EXPECT_GE(std::stod((*it)[2]), count_before);
    bound_before_s = bound_s;
    count_before = std::stod((*it)[2]);
  }
  EXPECT_EQ(buckets, 17);
  EXPECT_EQ(count_before, static_cast<double>(all));
  EXPECT_EQ(sample(page, R"(strainwave_wakeup_latency_seconds_count{prefix="SW"})"),
            static_cast<double>(all));
  // Buckets 0 to 20 are below 32 us.
  EXPECT_EQ(sample(page, R"(strainwave_wakeup_latency_seconds_bucket{prefix="SW",le="3.2e-05"})"),
            21.0 * 22.0 / 2.0);
  EXPECT_EQ(page.find("position_delay"), std::string::npos) << "no drive measures it";
}

TEST(DaemonMetrics, HaveEveryReasonOnce) {
  Fleet fleet;
  fleet.take({"SW", "", "TIMING"}, timing_v1{}, kNow_s);
  const std::string page = page_of(fleet);
  std::set<std::string> reasons;
  const std::regex refused(R"re(strainwave_orders_refused_total\{prefix="SW",reason="([^"]*)"\})re");
  for (auto it = std::sregex_iterator(page.begin(), page.end(), refused); it != std::sregex_iterator(); ++it)
    EXPECT_TRUE(reasons.insert((*it)[1]).second) << (*it)[1];
  EXPECT_EQ(reasons.size(), static_cast<std::size_t>(kReasonCount - 1));
}

std::set<std::string> names_in(const std::string& file, const std::string& pattern) {
  const std::string all = read_text_file(std::string(STRAINWAVE_SOURCE_DIR) + "/" + file);
  std::set<std::string> names;
  const std::regex name(pattern);
  for (auto it = std::sregex_iterator(all.begin(), all.end(), name); it != std::sregex_iterator(); ++it)
    names.insert((*it)[1]);
  return names;
}

/// The names of all metrics of joints and daemons, from the HELP lines of a page with every value known.
std::set<std::string> shown_names() {
  Fleet fleet;
  state_v1 state{};
  state.mode = static_cast<std::int32_t>(Mode::kTracking);
  state.setpoint_velocity_rad_s = 1.0;
  state.fault = 1;
  state.notices = static_cast<std::int32_t>(Notice::kOffStream);
  timing_v1 timing{};
  timing.position_delay_max_ns = 1;
  fleet.take(kElbow, state, kNow_s);
  fleet.take(kElbow, limits(), kNow_s);
  fleet.take(kElbow, temperature_v1{}, kNow_s);
  fleet.take(kElbow, state, kNow_s);
  fleet.take({"SW", "", "TIMING"}, timing, kNow_s);
  const std::string page = page_of(fleet);
  std::set<std::string> names;
  const std::regex help("# HELP ([a-z_]+) ");
  for (auto it = std::sregex_iterator(page.begin(), page.end(), help); it != std::sregex_iterator(); ++it)
    names.insert((*it)[1]);
  return names;
}

TEST(MetricNames, AreThoseOfThePage) {
  std::set<std::string> page = names_in("docs/telemetry.md", "\n\\| `(strainwave_[a-z_]+)` \\|");
  std::erase_if(page, [](const std::string& name) { return name.starts_with("strainwave_telemetry_"); });
  EXPECT_EQ(page, shown_names());
}

TEST(MetricNames, AreAsManyAsThePageReckonsWith) {
  Fleet fleet;
  timing_v1 timing{};
  fleet.take({"SW", "", "TIMING"}, timing, kNow_s);
  const auto series = [&] {
    std::istringstream page(page_of(fleet));
    std::size_t count = 0;
    for (std::string line; std::getline(page, line);)
      if (!line.starts_with('#')) ++count;
    return count;
  };
  const std::size_t of_daemon = series();
  state_v1 state{};
  state.mode = static_cast<std::int32_t>(Mode::kTracking);
  state.setpoint_velocity_rad_s = 1.0;
  fleet.take(kElbow, state, kNow_s);
  fleet.take(kElbow, limits(), kNow_s);
  fleet.take(kElbow, temperature_v1{}, kNow_s);
  fleet.take(kElbow, state, kNow_s);
  const std::size_t of_joint = series() - of_daemon;
  EXPECT_EQ(names_in("docs/telemetry.md", "A daemon has (\\d+) series"), std::set{std::to_string(of_daemon)});
  EXPECT_EQ(names_in("docs/telemetry.md", "each joint (\\d+)"), std::set{std::to_string(of_joint)});
}

TEST(AlertRules, AskOnlyForMetricsAndWordsThatThereAre) {
  std::set<std::string> shown = shown_names();
  for (const std::string& name : names_in("config/telemetry/alerts.yml", "(strainwave_[a-z_]+)")) {
    const std::string family = name.ends_with("_bucket") ? name.substr(0, name.size() - 7) : name;
    EXPECT_TRUE(shown.contains(family)) << name;
  }
  std::set<std::string> words;
  for (int i = 0; i < 64; ++i) {
    words.insert(std::string(to_text(static_cast<Reason>(i))));
    if (i < 31) words.insert(std::string(to_text(static_cast<Notice>(1 << i))));
  }
  for (const std::string& word : names_in("config/telemetry/alerts.yml", "(?:reason|notice)=\"([^\"]+)\""))
    EXPECT_TRUE(words.contains(word)) << word;
}

TEST(Fleet, ForgetsWhoFallsSilent) {
  Fleet fleet;
  fleet.take(kElbow, state_v1{}, kNow_s);
  fleet.take({"SW", "", "TIMING"}, timing_v1{}, kNow_s);
  fleet.forget_silent(kNow_s + Fleet::kSilent_s);
  EXPECT_EQ(fleet.joints().size(), 1U);
  fleet.forget_silent(kNow_s + Fleet::kSilent_s + 1.0);
  EXPECT_TRUE(fleet.joints().empty());
  EXPECT_TRUE(fleet.daemons().empty());
}

TEST(Fleet, HoldsNoMoreNamesThanItsBoundWhoeverMakesThemUp) {
  Fleet fleet;
  for (int i = 0; i < 5000; ++i) {
    fleet.take({"SW", "j" + std::to_string(i), "STATE"}, state_v1{}, kNow_s);
    fleet.take({"SW", "k" + std::to_string(i), "LIMITS"}, limits(), kNow_s);
    fleet.take({"P" + std::to_string(i), "", "TIMING"}, timing_v1{}, kNow_s);
  }
  EXPECT_EQ(fleet.joints().size(), Fleet::kMaxJoints);
  EXPECT_EQ(fleet.daemons().size(), Fleet::kMaxDaemons);
}

}  // namespace
}  // namespace strainwave
