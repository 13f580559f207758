// What StreamTarget makes of a sample: its time, its derivatives, and whether they may be believed.
#include <algorithm>
#include <cmath>
#include <limits>

#include "control/stream_target.h"

namespace strainwave {

namespace {

// The loop that is locked to the arrivals: its gains are those of a straight line through all of them, and then those that average
// over some forty.
constexpr double kLeastArrivalGain = 0.05;
constexpr double kLeastIntervalGain = 0.00125;
// For longer than this nobody is held up, and no motion goes on as it was.
constexpr double kLongestHoldUp_s = 0.06;
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

// Samples that were lost on the way leave whole intervals out; those that were held up do not. Where a sample lies tells which it is: it
// is the one that its motion brings nearest.
double StreamTarget::intervals_in(double gap, double position_rad) const noexcept {
  const double most = std::max(1.0, std::round(gap / interval_));
  if (past_count_ < 2 || past_[0].velocity_rad_s == 0.0 || seconds(gap) > kLongestHoldUp_s) return most;
  double intervals = most;
  double least_rad = std::numeric_limits<double>::infinity();
  for (double n = most; n >= 1.0; n -= 1.0) {
    const double s = seconds(n * interval_);
    const double off_rad =
        std::abs(past_[0].position_rad +
                 s * (past_[0].velocity_rad_s + 0.5 * s * past_[0].acceleration_rad_s2) - position_rad);
    if (off_rad >= least_rad) continue;
    least_rad = off_rad;
    intervals = n;
  }
  return intervals;
}

void StreamTarget::clock_in(double position_rad) noexcept {
  ++arrivals_;
  const double gap = present() - arrival_;
  if (arrivals_ <= 2) {
    interval_ = arrivals_ == 2 ? std::max(gap, 1.0) : 0.0;
    arrival_ = present();
    return;
  }
  const double n = arrivals_;
  const double intervals = intervals_in(gap, position_rad);
  // What was held up says nothing of the sender's clock.
  const double late = std::min(gap - intervals * interval_, 0.5 * interval_);
  arrival_ +=
      intervals * interval_ + std::max(kLeastArrivalGain, 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0))) * late;
  interval_ += std::max(kLeastIntervalGain, 6.0 / (n * (n + 1.0))) * late / intervals;
  interval_ = std::max(interval_, 1.0);
}

void StreamTarget::remember(const Knot& knot) noexcept {
  std::copy_backward(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = knot;
  past_count_ = std::min(past_count_ + 1, kPast);
  hull_ = {};
  for (std::size_t i = 0; i < past_count_; ++i) hull_.widen(past_[i]);
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

// Whether the last that waits lies nearer to the one before than velocities are estimated from: their errors, over a shorter time, would be
// accelerations.
bool StreamTarget::crowds(const Knot& knot) const noexcept {
  if (waiting_.empty()) return false;
  const Knot& before = waiting_.size() > 1 ? waiting_.last_but_one() : to_;
  return seconds(knot.at - before.at) <= kApart_s + 0.5 * period_s_;
}

// What the motion went wrong where it was carried on is put right as slowly as for an untimed knot.
void StreamTarget::queue(const StreamSample& sample, const Knot& knot) noexcept {
  interval_ = past_count_ >= 2 ? past_[0].at - past_[1].at : knot.at - present();
  if (past_count_ >= 3) interval_ = std::min(interval_, past_[1].at - past_[2].at);
  arrivals_ = 0;
  const bool follows = !to_.carried && knot.at > to_.at && now_ <= to_.at + 0.5 && knot.at >= now_ + 1.0;
  if (waiting_.empty() && !follows) {
    const double ahead = now_ + least_ahead() - knot.at;
    return lead_to(std::max(ahead, caught_up_at_ - knot.at) > 0.0 ? carried_forward(sample, knot, ahead)
                                                                  : knot);
  }
  if (waiting_.empty() && now_ >= to_.at) return lead_to(knot);
  if (sample.derivatives == 0 && crowds(knot)) return waiting_.replace_last(knot);
  waiting_.push(knot);
}

}  // namespace strainwave
