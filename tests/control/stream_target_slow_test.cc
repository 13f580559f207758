// A sine streamed in positions, 20 to 50 a second, with when they were sent: whatever a sender's timer does to that, and wherever the stream begins,
// samples that are lost at full speed leave it where it was. At one that is lost the motion is extrapolated by up to two intervals from the last:
// the polynomial through five exact samples of this sine then misses it by 0.3 mrad, and twenty times what a sample is off.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "control/trajectory/stream_target.h"

namespace strainwave {
namespace {

constexpr double kSlowPeriod_s = 0.001;
constexpr double kSlowAmplitude_rad = 0.5;
constexpr double kSlowOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr double kOnTheWay_s = 0.0003;
constexpr double kRigidLead = 1.0;   ///< periods
constexpr double kSpringLead = 8.0;  ///< likewise
constexpr StreamTarget::Reach kSlowReach{6.0, 150.0};

double slow_sine_rad(double t_s) {
  return kSlowAmplitude_rad * std::sin(kSlowOmega_rad_s * t_s);
}

struct Sender {
  const char* name = "";
  double rate_Hz = 20.0;
  double late_s = 0.0;         ///< it sends up to so much later than it planned
  double told_late_s = 0.0;    ///< it reads its clock up to so much later still
  bool of_its_plan = true;     ///< a position is for when it was planned to be sent; else for when it was
  double first_gap_s = 0.0;    ///< from the first sample to the second; 0: an interval
  double first_at_s = 0.0137;  ///< into a period as well
};

struct Sent {
  double comes_s = 0.0;
  double told_s = 0.0;
  double position_rad = 0.0;
};

/// Without those of `lost`, which are counted from the first.
std::vector<Sent> slow_samples(const Sender& sender, double jitter_s, const std::vector<int>& lost,
                               unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&] { return std::generate_canonical<double, 32>(random); };
  std::vector<Sent> sent;
  double plan_s = sender.first_at_s;
  for (int i = 0; plan_s < 7.0; ++i) {
    const double at_s = plan_s + sender.late_s * chance();
    const double told_s = at_s + sender.told_late_s * chance();
    const double comes_s = told_s + kOnTheWay_s + jitter_s * chance();
    if (std::find(lost.begin(), lost.end(), i) == lost.end())
      sent.push_back({comes_s, told_s, slow_sine_rad(sender.of_its_plan ? plan_s : at_s)});
    plan_s += i == 0 && sender.first_gap_s > 0.0 ? sender.first_gap_s : 1.0 / sender.rate_Hz;
  }
  return sent;
}

/// Largest distance from the sine that is so much later than the samples, from `from_s` on; the amplitude where the motion ends.
double slow_error_rad(const std::vector<Sent>& samples, double lag_s, double lead, double from_s) {
  StreamTarget target(kSlowPeriod_s, 0.05);
  target.begin(0.0, 0.0, lead);
  double largest_rad = 0.0;
  std::size_t next = 0;
  for (int k = 0; k < 6000; ++k) {
    const double t_s = k * kSlowPeriod_s;
    if (target.ended()) target.resume(slow_sine_rad(t_s - lag_s), 0.0, {});
    for (; next < samples.size() && samples[next].comes_s <= t_s; ++next) {
      StreamSample sample{samples[next].position_rad};
      sample.sent_us = 1'700'000'000'000'000 + std::llround(1e6 * samples[next].told_s);
      target.take(sample, kSlowReach);
    }
    const double at_rad = target.step().position_rad;
    if (t_s < from_s) continue;
    if (target.ended()) return kSlowAmplitude_rad;
    const double sine_rad = slow_sine_rad(t_s + lead * kSlowPeriod_s - lag_s);
    largest_rad = std::max(largest_rad, std::abs(at_rad - sine_rad));
  }
  return largest_rad;
}

struct Worst {
  double one_lost_rad = 0.0;
  double two_lost_rad = 0.0;
};

/// Of samples that are lost, one or two in a row, at all speeds from full to none.
Worst worst_of(const Sender& sender) {
  constexpr double kFrom_s = 2.0;
  const int first = static_cast<int>(3.5 * sender.rate_Hz), last = static_cast<int>(4.6 * sender.rate_Hz);
  Worst worst;
  for (const double lead : {kRigidLead, kSpringLead})
    for (const double jitter_s : {0.0, 0.001, 0.003, 0.005})
      for (unsigned seed = 1; seed <= 1; ++seed) {
        // Half a period on average until one is taken, and what is late on average.
        const double lag_s =
            1.0 / sender.rate_Hz + 0.5 * kSlowPeriod_s + kOnTheWay_s +
            0.5 * (jitter_s + sender.told_late_s + (sender.of_its_plan ? sender.late_s : 0.0));
        Sender shifted = sender;
        shifted.first_at_s += 0.0171 * seed;
        for (int i = first; i < last; ++i) {
          const auto error_rad = [&](const std::vector<int>& lost) {
            return slow_error_rad(slow_samples(shifted, jitter_s, lost, seed), lag_s, lead, kFrom_s);
          };
          worst.one_lost_rad = std::max(worst.one_lost_rad, error_rad({i}));
          worst.two_lost_rad = std::max(worst.two_lost_rad, error_rad({i, i + 1}));
        }
      }
  std::printf("%-44s %3.0f Hz, first gap %5.1f ms: one lost %4.1f mrad, two %4.1f mrad\n", sender.name,
              sender.rate_Hz, 1e3 * sender.first_gap_s, 1e3 * worst.one_lost_rad, 1e3 * worst.two_lost_rad);
  return worst;
}

TEST(StreamTargetSlow, IsOnTheMotionWhateverTheTimerDoesAndOneIsLost) {
  for (const double rate_Hz : {20.0, 25.0, 1000.0 / 30.0, 50.0})
    for (const Sender& sender :
         {Sender{.name = "a timer that is on time", .rate_Hz = rate_Hz},
          Sender{.name = "late by up to 0.3 ms, of its plan", .rate_Hz = rate_Hz, .late_s = 0.0003},
          Sender{.name = "late by up to 1 ms, of its plan", .rate_Hz = rate_Hz, .late_s = 0.001},
          Sender{.name = "late by up to 2 ms, of its plan", .rate_Hz = rate_Hz, .late_s = 0.002},
          Sender{.name = "late by up to 5 ms, by its clock",
          .rate_Hz = rate_Hz,
          .late_s = 0.005,
          .of_its_plan = false},
          Sender{.name = "likewise, its clock read 0.1 ms later",
          .rate_Hz = rate_Hz,
          .late_s = 0.005,
          .told_late_s = 0.0001,
          .of_its_plan = false}}) {
      const Worst worst = worst_of(sender);
      EXPECT_LT(worst.one_lost_rad, 3e-3) << sender.name << ", " << rate_Hz << " Hz";
      EXPECT_LT(worst.two_lost_rad, sender.told_late_s > 0.0 ? 7e-3 : 3e-3)
          << sender.name << ", " << rate_Hz << " Hz";
    }
}

TEST(StreamTargetSlow, FindsTheRhythmWhereverTheFirstSampleLay) {
  for (const double first_gap_s : {0.002, 0.005, 0.010, 0.0167, 0.020, 0.025, 0.030, 0.040, 0.070, 0.130}) {
    const Worst worst = worst_of({.name = "first gap", .first_gap_s = first_gap_s});
    EXPECT_LT(worst.one_lost_rad, 3e-3) << first_gap_s;
    EXPECT_LT(worst.two_lost_rad, 3e-3) << first_gap_s;
  }
}

}  // namespace
}  // namespace strainwave
