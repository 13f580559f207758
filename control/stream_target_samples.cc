// What StreamTarget makes of a sample: its time, its derivatives, and whether they may be believed.
#include <algorithm>
#include <cmath>

#include "control/stream_target.h"

namespace strainwave {

namespace {

// The loop that is locked to the arrivals: its gains are those of a straight line through all of them, and then those that average
// over some forty.
constexpr double kLeastArrivalGain = 0.05;
constexpr double kLeastIntervalGain = 0.00125;
// Velocities are estimated from positions that are at least so far apart.
constexpr double kApart_s = 0.01;
// A velocity may differ from that of the positions by these shares of the limit (the less, the farther apart the samples are) and of
// itself, for what arrivals do to times, and by what acceleration makes of it meanwhile: so many times the positions' own.
constexpr double kDoubtOfLimit = 0.02;
constexpr double kDoubtOfItself = 0.5;
constexpr double kDoubtOfAcceleration = 2.0;

/// At the newest of three values that lie on a parabola.
struct Slope {
  double rate = 0.0;
  double change = 0.0;
};

/// By the mean rates of the newer and the older interval.
Slope slope_at_newest(double newer, double newer_s, double older, double older_s) noexcept {
  const double change = 2.0 * (newer - older) / (newer_s + older_s);
  return {newer + 0.5 * newer_s * change, change};
}

}  // namespace

// Whether the velocity that it gives is not that of its positions: in degrees, of another sign, or left over. Followed, it would take the
// joint away from every position that was sent.
bool StreamTarget::contradicts_itself(const Knot& knot, const Before& before) const noexcept {
  const auto [last, first] = before;
  if (last == nullptr) return false;
  const double doubt_rad_s = kDoubtOfLimit * reach_.velocity_rad_s * std::min(1.0, kApart_s / mean_s_) +
                             kDoubtOfItself * std::min(std::abs(knot.velocity_rad_s), std::abs(mean_rad_s_));
  double acceleration_rad_s2 = reach_.acceleration_rad_s2;
  if (first != nullptr) {
    const double older_s = seconds(last->at - first->at);
    const double older_rad_s = (last->position_rad - first->position_rad) / older_s;
    const double own_rad_s2 = 2.0 * std::abs(mean_rad_s_ - older_rad_s) / (mean_s_ + older_s);
    acceleration_rad_s2 = std::min(acceleration_rad_s2, kDoubtOfAcceleration * own_rad_s2);
  }
  const double changed_rad_s = acceleration_rad_s2 * mean_s_;
  const double between_rad_s = 0.5 * (knot.sent_rad_s + last->sent_rad_s);
  return std::abs(knot.velocity_rad_s - mean_rad_s_) > doubt_rad_s + changed_rad_s ||
         std::abs(between_rad_s - mean_rad_s_) > doubt_rad_s + 0.5 * changed_rad_s;
}

// Samples that were lost on the way leave whole intervals out.
void StreamTarget::clock_in() noexcept {
  ++arrivals_;
  const double gap = present() - arrival_;
  if (arrivals_ <= 2) {
    interval_ = arrivals_ == 2 ? std::max(gap, 1.0) : 0.0;
    arrival_ = present();
    return;
  }
  const double n = arrivals_;
  const double intervals = std::max(1.0, std::round(gap / interval_));
  const double late = gap - intervals * interval_;
  arrival_ +=
      intervals * interval_ + std::max(kLeastArrivalGain, 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0))) * late;
  interval_ += std::max(kLeastIntervalGain, 6.0 / (n * (n + 1.0))) * late / intervals;
  interval_ = std::max(interval_, 1.0);
}

void StreamTarget::remember(const Knot& knot) noexcept {
  std::copy_backward(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = knot;
  past_count_ = std::min(past_count_ + 1, kPast);
  hull_ = {knot.position_rad, knot.position_rad, 0.0};
  for (std::size_t i = 0; i < past_count_; ++i) {
    hull_.low_rad = std::min(hull_.low_rad, past_[i].position_rad);
    hull_.high_rad = std::max(hull_.high_rad, past_[i].position_rad);
    hull_.fastest_rad_s = std::max(hull_.fastest_rad_s, std::abs(past_[i].velocity_rad_s));
  }
}

// The newest sample that is kApart_s older than `period`, or the oldest that there is.
const StreamTarget::Knot* StreamTarget::sample_before(double period) const noexcept {
  const Knot* found = nullptr;
  for (std::size_t i = 0; i < past_count_; ++i) {
    if (past_[i].at >= period) continue;
    found = &past_[i];
    if (seconds(period - found->at) >= kApart_s - 0.5 * period_s_) break;
  }
  return found;
}

void StreamTarget::estimate_derivatives(const StreamSample& sample, const Before& before,
                                        Knot& knot) noexcept {
  const auto [last, first] = before;
  if (sample.derivatives < 2) knot.acceleration_rad_s2 = 0.0;
  if (sample.derivatives < 1) knot.velocity_rad_s = 0.0;
  if (last == nullptr) return;
  if (sample.derivatives == 0) return derive_from_positions(before, knot);
  if (sample.derivatives == 2) {
    knot.jerk_rad_s3 = (knot.acceleration_rad_s2 - last->acceleration_rad_s2) / mean_s_;
    return;
  }
  // Slope of a parabola through three velocities, or of a line through two.
  knot.acceleration_rad_s2 = (knot.velocity_rad_s - last->velocity_rad_s) / mean_s_;
  if (first == nullptr) return;
  const double older_s = seconds(last->at - first->at);
  const double older_rad_s2 = (last->velocity_rad_s - first->velocity_rad_s) / older_s;
  const Slope slope = slope_at_newest(knot.acceleration_rad_s2, mean_s_, older_rad_s2, older_s);
  knot.acceleration_rad_s2 = slope.rate;
  knot.jerk_rad_s3 = slope.change;
}

// Likewise. What needs more acceleration than can be is a place: nothing before it says anything about a motion.
void StreamTarget::derive_from_positions(const Before& before, Knot& knot) noexcept {
  const auto [last, first] = before;
  const bool stands = past_count_ >= 2 && knot.position_rad == past_[0].position_rad &&
                      knot.position_rad == past_[1].position_rad && knot.position_rad == last->position_rad;
  if (stands) return;
  if (first == nullptr) {
    const double possible = kReach * reach_.acceleration_rad_s2 * mean_s_;
    if (std::abs(mean_rad_s_ - state_.velocity_rad_s) <= possible) knot.velocity_rad_s = mean_rad_s_;
    return;
  }
  const double older_s = seconds(last->at - first->at);
  const double older_rad_s = (last->position_rad - first->position_rad) / older_s;
  const Slope slope = slope_at_newest(mean_rad_s_, mean_s_, older_rad_s, older_s);
  if (std::abs(slope.change) > kReach * reach_.acceleration_rad_s2) {
    past_count_ = 0;
    return;
  }
  knot.velocity_rad_s = slope.rate;
  knot.acceleration_rad_s2 = slope.change;
}

}  // namespace strainwave
