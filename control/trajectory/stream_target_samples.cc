// What StreamTarget makes of a sample: where it is carried to.
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "control/trajectory/stream_target.h"

namespace strainwave {

namespace {

// Of so many samples that are stamped the least of their intervals is the stream's: others were lost. Where a fifth is lost, all of six
// came after a loss once in 3000 samples, of twelve once in 50 million.
constexpr std::size_t kIntervals = 12;
// Streams whose jerk is carried on: just those of 100 Hz.
constexpr double kJerkGoesOn_s = 0.009;
}  // namespace

// What was taken for this period and later, of samples with a time of their own: a newer one is for before the last of them. The same time again
// is a double. Where the motion was on its way to one of them it goes on from where it is, as after samples that were missed.
void StreamTarget::withdraw_from(double period) noexcept {
  if (past_count_ == 0 || !past_[0].stamped || past_[0].at <= period) return;
  waiting_.drop_from(period);
  const auto end = past_.begin() + static_cast<std::ptrdiff_t>(std::min(past_count_ + left_behind_, kPast));
  const auto kept = std::find_if(past_.begin(), end, [&](const Knot& one) { return one.at < period; });
  past_count_ = static_cast<std::size_t>(end - kept);
  left_behind_ = 0;
  std::copy(kept, end, past_.begin());
  if (to_.at < period) return;
  to_ = {now_, state_.position_rad, state_.velocity_rad_s, state_.acceleration_rad_s2};
  to_.carried = true;
  to_.due = now_;
}

void StreamTarget::remember(const Knot& knot) noexcept {
  std::copy_backward(past_.begin(), past_.end() - 1, past_.end());
  past_[0] = knot;
  past_count_ = std::min(past_count_ + 1, kPast);
  hull_ = {};
  for (std::size_t i = 0; i < past_count_; ++i) hull_.widen(past_[i]);
}

// The newest sample that is `apart_s` older than `period`, or the oldest that there is.
const StreamTarget::Knot* StreamTarget::sample_before(double period, double apart_s) const noexcept {
  const Knot* found = nullptr;
  for (std::size_t i = 0; i < past_count_; ++i) {
    if (past_[i].at >= period) continue;
    found = &past_[i];
    if (seconds(period - found->at) >= apart_s - 0.5 * period_s_) break;
  }
  return found;
}

// In fast streams it would be their noise.
double StreamTarget::carried_on_jerk_rad_s3(const Knot& knot) const noexcept {
  return knot.smooth && seconds(expected_interval()) > kJerkGoesOn_s ? knot.jerk_rad_s3 : 0.0;
}

// By `least_ahead` periods from its time, or until what was missed is caught up with.
StreamTarget::Knot StreamTarget::carried_forward(const StreamSample& sample, const Knot& knot,
                                                 double least_ahead, double lag) const noexcept {
  const double interval = expected_interval();
  // One that was held up has its time behind it.
  const double late = present() - knot.at > interval ? present() - knot.at : 0.0;
  const double ahead = std::max(late + least_ahead, caught_up_at_ - knot.at);
  if (sample.derivatives > 0) lag = 0.0;
  lag = std::clamp(lag, 0.0, interval);
  const double carried_s = knot.velocity_rad_s == 0.0 ? 0.0 : seconds(ahead - lag);
  const double jerk_rad_s3 = ahead <= interval + lead_ ? knot.jerk_rad_s3 : carried_on_jerk_rad_s3(knot);
  Knot carried = knot;
  carried.carried = true;
  carried.at = std::max(knot.at + ahead, begins() + 1.0);
  carried.due = std::max(knot.at + least_ahead, begins() + 1.0);
  carried.acceleration_rad_s2 += carried_s * jerk_rad_s3;
  carried.velocity_rad_s += carried_s * (knot.acceleration_rad_s2 + 0.5 * carried_s * jerk_rad_s3);
  carried.position_rad +=
      carried_s *
      (knot.velocity_rad_s + carried_s * (0.5 * knot.acceleration_rad_s2 + carried_s * jerk_rad_s3 / 6.0));
  if (mean_s_ == 0.0) return carried;
  const double line_rad = knot.position_rad + carried_s * mean_rad_s_;
  const double farthest_rad = 0.5 * reach_.acceleration_rad_s2 * carried_s * (carried_s + mean_s_);
  carried.position_rad = std::clamp(carried.position_rad, line_rad - farthest_rad, line_rad + farthest_rad);
  return carried;
}

// Whether the last that waits lies nearer to the one before than velocities are estimated from: their errors, over a shorter time, would be
// accelerations.
bool StreamTarget::crowds(const Knot& knot) const noexcept {
  if (waiting_.empty()) return false;
  const Knot& before = waiting_.size() > 1 ? waiting_[waiting_.size() - 2] : to_;
  return seconds(knot.at - before.at) <= kApart_s + 0.5 * period_s_;
}

// What the motion went wrong where it was carried on is put right as slowly as for an untimed knot.
void StreamTarget::queue(const StreamSample& sample, const Knot& knot) noexcept {
  interval_ = past_count_ >= 2 ? past_[0].at - past_[1].at : knot.at - present();
  for (std::size_t i = 1; i + 1 < std::min(past_count_, kIntervals); ++i)
    interval_ = std::min(interval_, past_[i].at - past_[i + 1].at);
  arrivals_ = 0;
  const bool follows = !to_.carried && knot.at > to_.at && now_ <= to_.at + 0.5 && knot.at >= now_ + 1.0;
  if (waiting_.empty() && !follows) {
    const double ahead = now_ + least_ahead() - knot.at;
    if (std::max(ahead, caught_up_at_ - knot.at) <= 0.0) return lead_to(knot);
    double longest = 0.0;
    for (std::size_t i = 0; i < std::min(past_count_, kIntervals); ++i)
      longest = std::max(longest, past_[i].sent_ahead);
    return lead_to(carried_forward(sample, knot, ahead, least_ahead() - longest));
  }
  if (waiting_.empty() && now_ >= to_.at) return lead_to(knot);
  if (sample.derivatives == 0 && crowds(knot)) return waiting_.replace_last(knot);
  waiting_.push(knot);
}

// One that is told of when it acts is late already: it is there an interval later.
void StreamTarget::lead_load_to(const Knot& knot) noexcept {
  load_from_ = load_;
  load_to_ = knot.load;
  load_from_at_ = now_;
  load_to_at_ = knot.carried ? std::min(knot.at, now_ + expected_interval()) : knot.at;
}

ToldLoad StreamTarget::load_at(double period) const noexcept {
  if (period >= load_to_at_) return load_to_;
  const double share = (period - load_from_at_) / (load_to_at_ - load_from_at_);
  return {load_from_.torque_Nm + share * (load_to_.torque_Nm - load_from_.torque_Nm),
          load_from_.inertia_kgm2 + share * (load_to_.inertia_kgm2 - load_from_.inertia_kgm2)};
}

}  // namespace strainwave
