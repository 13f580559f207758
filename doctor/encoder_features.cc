// SPDX-License-Identifier: BSD-3-Clause
// Features from positions only: noise, and the link's encoder against the motor's.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "doctor/features.h"
#include "doctor/stretches.h"

namespace strainwave {

namespace {

constexpr double kNoiseTolerance = 0.25;
constexpr double kLinkTolerance = 0.002;
constexpr double kSlipTolerance_rad = 0.002;  // a gear's wind-up at a few N.m
constexpr double kSteady = 0.02;
constexpr double kFastShare = 0.5;  // of the fastest motion
constexpr double kStanding_rad_s = 0.05;

// Third differences remove a steady acceleration, and have 20 times the variance of white noise.
void add_noise(const Evidence& evidence, const std::vector<Stretch>& stretches, Features& features) {
  std::vector<double> squares;
  for (const Stretch& stretch : stretches)
    for (std::size_t i = 3; i < stretch.position_rad.size(); ++i) {
      if (!stretch.at_rest[i] || !stretch.at_rest[i - 3]) continue;
      const double* at = &stretch.position_rad[i];
      squares.push_back(std::pow(at[0] - 3.0 * at[-1] + 3.0 * at[-2] - at[-3], 2) / 20.0);
    }
  if (squares.size() < 50) {
    features.not_judged.emplace_back(
        "electrical noise: the joint never rests under control in this recording");
    return;
  }
  double sum = 0.0;
  for (const double square : squares) sum += square;
  const double noise_rad = std::sqrt(sum / static_cast<double>(squares.size()));
  const double count_rad = evidence.count_rad();
  features[Feature::kNoise] =
      Observation{std::max(0.0, std::log(noise_rad / count_rad)), kNoiseTolerance,
                  fmt::format("at rest the position has {:.1e} rad of noise, a count is {:.1e} rad",
                              noise_rad, count_rad)};
}

struct Travel {
  double motor_rad = 0.0, link_rad = 0.0;
  double ratio() const { return link_rad / motor_rad; }
};

bool is_steady(const Stretch& stretch, std::size_t i) {
  const double now_rad_s = stretch.velocity_rad_s[i];
  return std::abs(stretch.velocity_rad_s[i - 10] - now_rad_s) <= kSteady * std::abs(now_rad_s) + 0.005;
}

// The spring has the same wind-up in each steady motion or rest. A relative motion from one to the next is slip.
double slipped_rad(const std::vector<Stretch>& stretches, double link_ratio) {
  double most_rad = 0.0;
  for (const Stretch& stretch : stretches) {
    double turned_rad = 0.0;
    for (std::size_t i = 10; i < stretch.position_rad.size(); ++i) {
      if (!std::isfinite(stretch.link_rad[i]) || !std::isfinite(stretch.link_rad[i - 1])) continue;
      if (is_steady(stretch, i)) {
        most_rad = std::max(most_rad, std::abs(turned_rad));
        turned_rad = 0.0;
      } else {
        turned_rad += stretch.link_rad[i] - stretch.link_rad[i - 1] -
                      link_ratio * (stretch.position_rad[i] - stretch.position_rad[i - 1]);
      }
    }
  }
  return most_rad;
}

void add_link(const std::vector<Stretch>& stretches, Features& features) {
  double fastest = 0.0;
  bool there = false;
  for (const Stretch& stretch : stretches)
    for (std::size_t i = 0; i < stretch.position_rad.size(); ++i) {
      fastest = std::max(fastest, std::abs(stretch.velocity_rad_s[i]));
      there = there || std::isfinite(stretch.link_rad[i]);
    }
  if (!there) {
    features.not_judged.emplace_back(
        "slipping coupling, and counts that go missing without a fault: only an encoder at the link shows "
        "them");
    return;
  }
  Travel slow, fast;
  for (const Stretch& stretch : stretches) {
    for (std::size_t i = 1; i < stretch.position_rad.size(); ++i) {
      const double speed = std::abs(stretch.velocity_rad_s[i]);
      const double way = std::copysign(1.0, stretch.velocity_rad_s[i]);
      if (speed < kStanding_rad_s || !std::isfinite(stretch.link_rad[i]) ||
          !std::isfinite(stretch.link_rad[i - 1]))
        continue;
      // Only steady motion counts, because a coupling slips during acceleration. Counts are lost at high speed.
      if (i < 10 || !is_steady(stretch, i)) continue;
      Travel& travel = speed > kFastShare * fastest ? fast : slow;
      travel.motor_rad += way * (stretch.position_rad[i] - stretch.position_rad[i - 1]);
      travel.link_rad += way * (stretch.link_rad[i] - stretch.link_rad[i - 1]);
    }
  }
  if (slow.motor_rad < 0.1 || slow.link_rad <= 0.0) return;
  const auto add_ratio = [&](Feature feature, double value, double travel_rad, const std::string& text) {
    features[feature] = Observation{value, std::hypot(kLinkTolerance, 1e-3 / travel_rad), text};
  };
  add_ratio(Feature::kLinkRatio, std::log(slow.ratio()), slow.motor_rad,
            fmt::format("in slow motion the link turned {:.4f} rad, the motor's encoder says {:.4f}",
                        slow.link_rad, slow.motor_rad));
  if (fast.motor_rad > 0.1 && fast.link_rad > 0.0)
    add_ratio(Feature::kLinkRatioFast, std::log(fast.ratio() / slow.ratio()), fast.motor_rad,
              fmt::format("in fast motion the link turned {:.4f} rad, the motor's encoder says {:.4f}",
                          fast.link_rad, fast.motor_rad));
  const double drift_rad = slipped_rad(stretches, slow.ratio());
  features[Feature::kLinkJumps] = Observation{
      drift_rad, kSlipTolerance_rad,
      fmt::format("while the joint accelerated the link turned by {:.4f} rad against the motor", drift_rad)};
}

}  // namespace

void add_encoder_features(const Evidence& evidence, Features& features) {
  const std::vector<Stretch> stretches = controlled_stretches(evidence);
  add_noise(evidence, stretches, features);
  add_link(stretches, features);
}

}  // namespace strainwave
