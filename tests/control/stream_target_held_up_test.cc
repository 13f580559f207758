// Streams that are not stamped, begun in the middle of a fast motion, with the jitter of a network, and samples that are held up once and then come all
// at once, or come faster from some instant on: what follows them must come up with them and stay there, and not swing between its limits for a second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "control/trajectory/reference_shaper.h"
#include "control/trajectory/stream_target.h"

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kJitter_s = 0.002;
constexpr double kAmplitude_rad = 0.5;
constexpr double kOmega_rad_s = 2.0 * std::numbers::pi * 0.5;
constexpr MotionLimits kLimits{8.0, 60.0, 80.0};
constexpr StreamTarget::Reach kReach{8.0, 60.0};
// By then it has come up with the sine, at 5 rad/s^2.
constexpr int kBegin = 150;
constexpr int kEnd = 2900;
constexpr double kHard_rad_s2 = 25.0;
constexpr double kFar_rad = 6e-3;

struct Arrival {
  double at_s = 0.0;
  double of_s = 0.0;
  std::int64_t sent_us = 0;  ///< 0: not told
};

/// Those of `held_up_s` between 0.2 and 0.4 s come all at once.
std::vector<Arrival> arrivals(double rate_Hz, double held_up_s, unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&] { return std::generate_canonical<double, 32>(random); };
  const double from_s = 0.2 + 0.2 * chance();
  std::vector<Arrival> all;
  for (int i = 0; i / rate_Hz < kPeriod_s * kEnd; ++i) {
    Arrival one{i / rate_Hz + kJitter_s * chance(), i / rate_Hz};
    if (one.of_s >= from_s && one.of_s < from_s + held_up_s) one.at_s = from_s + held_up_s;
    if (!all.empty()) one.at_s = std::max(one.at_s, all.back().at_s);
    all.push_back(one);
  }
  return all;
}

struct Followed {
  int hard_periods = 0;  ///< in which the reference accelerates by far more than the sine
  double farthest_rad = 0.0;
  int far_periods = 0;
};

Followed follow(const std::vector<Arrival>& all) {
  StreamTarget target(kPeriod_s, 0.05);
  target.begin(0.0, 0.0, 0.0);
  ReferenceShaper shaper(kPeriod_s);
  shaper.set_limits(kLimits);
  shaper.reset(0.0, 0.0);
  StreamTarget::Confinement confined = 0;
  std::size_t next = 0;
  Followed followed;
  for (int k = 0; k < kEnd; ++k) {
    for (; next < all.size() && all[next].at_s <= k * kPeriod_s; ++next) {
      if (target.ended()) target.resume(shaper.position_rad(), shaper.velocity_rad_s(), {});
      const double phase = kOmega_rad_s * all[next].of_s;
      StreamSample sample{kAmplitude_rad * std::sin(phase), kAmplitude_rad * kOmega_rad_s * std::cos(phase),
                          0.0, 1};
      sample.sent_us = all[next].sent_us;
      target.take(sample, kReach);
    }
    Reference reference;
    if (target.ended()) {
      shaper.stop();
      target.wait(1);
      reference = shaper.step();
    } else {
      const MovingTarget moving = target.step();
      reference = shaper.follow(
          target.confined(moving, shaper.position_rad(), shaper.velocity_rad_s(), confined), {});
    }
    if (k < kBegin) continue;
    const double off_rad =
        std::abs(reference.position_rad - kAmplitude_rad * std::sin(kOmega_rad_s * kPeriod_s * (k - 1)));
    followed.farthest_rad = std::max(followed.farthest_rad, off_rad);
    followed.far_periods += off_rad > kFar_rad ? 1 : 0;
    followed.hard_periods += std::abs(reference.acceleration_rad_s2) > kHard_rad_s2 ? 1 : 0;
  }
  return followed;
}

int most_hard_periods(double rate_Hz, double held_up_s) {
  int most = 0;
  for (unsigned seed = 0; seed < 20; ++seed)
    most = std::max(most, follow(arrivals(rate_Hz, held_up_s, seed)).hard_periods);
  return most;
}

// Fast streams were left and gone after again, in turns, up to the end of the swing: 343 periods at 500 Hz. 100 ms are more than is bridged: the
// joint decelerates and comes up with the stream again. After what was taken for lost and came after all it did not for 1.2 s.
TEST(StreamTargetHeldUp, ComesUpWithTheStreamAndStaysThere) {
  for (const double rate_Hz : {20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
    for (const double held_up_s : {0.0, 0.02, 0.05})
      EXPECT_LE(most_hard_periods(rate_Hz, held_up_s), 30) << rate_Hz << " Hz, " << held_up_s << " s";
    EXPECT_LE(most_hard_periods(rate_Hz, 0.1), 200) << rate_Hz << " Hz, 0.1 s";
  }
}

/// From 1 to 1.5 s on at another rate; `late_s` at most by the sender's timer.
std::vector<Arrival> faster(double rate_Hz, double then_Hz, double late_s, bool told, unsigned seed) {
  std::mt19937 random(seed);
  const auto chance = [&] { return std::generate_canonical<double, 32>(random); };
  const double from_s = 1.0 + 0.5 * chance();
  std::vector<Arrival> all;
  for (double of_s = 0.0; of_s < kPeriod_s * kEnd; of_s += 1.0 / (of_s < from_s ? rate_Hz : then_Hz)) {
    const double sent_s = of_s + late_s * chance();
    all.push_back({sent_s + 3e-4 + 2e-4 * chance(), of_s,
                   told ? 1'000'000 + static_cast<std::int64_t>(1e6 * sent_s) : 0});
  }
  return all;
}

Followed worst_of_faster(double rate_Hz, double then_Hz, double late_s, bool told) {
  Followed worst;
  for (unsigned seed = 0; seed < 10; ++seed) {
    const Followed one = follow(faster(rate_Hz, then_Hz, late_s, told, seed));
    worst.farthest_rad = std::max(worst.farthest_rad, one.farthest_rad);
    worst.far_periods = std::max(worst.far_periods, one.far_periods);
  }
  return worst;
}

// Nobody sends a sample before its time: where the rhythm says so it is over. It went on for half a second and more, 32 to 310 mrad off.
TEST(StreamTargetFaster, IsFollowedByWhenItsSamplesWereSent) {
  for (const auto& [rate_Hz, then_Hz] :
       {std::pair{100.0, 125.0}, std::pair{100.0, 200.0}, std::pair{100.0, 500.0}, std::pair{50.0, 100.0},
        std::pair{20.0, 100.0}})
    for (const double late_s : {3e-4, 2e-3}) {
      const Followed told = worst_of_faster(rate_Hz, then_Hz, late_s, true);
      EXPECT_LT(told.farthest_rad, 20e-3) << rate_Hz << " to " << then_Hz << " Hz";
      EXPECT_LT(told.far_periods, 200) << rate_Hz << " to " << then_Hz << " Hz";
      const Followed untold = worst_of_faster(rate_Hz, then_Hz, late_s, false);
      EXPECT_LT(untold.farthest_rad, 95e-3) << rate_Hz << " to " << then_Hz << " Hz";
      EXPECT_LT(untold.far_periods, 750) << rate_Hz << " to " << then_Hz << " Hz";
    }
}

}  // namespace
}  // namespace strainwave
