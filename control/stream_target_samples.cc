// What StreamTarget makes of a sample: its time, and where it is carried to.
#include <algorithm>
#include <cmath>

#include "control/stream_target.h"

namespace strainwave {

namespace {

// The loop that is locked to the arrivals: its gains are those of a straight line through all of them, and then those that average
// over some forty.
constexpr double kLeastArrivalGain = 0.05;
constexpr double kLeastIntervalGain = 0.00125;
// For longer than this nobody is held up, and no motion goes on as it was.
constexpr double kLongestHoldUp_s = 0.06;
// If those of so long a time were all held up, it was others that were lost before them.
constexpr double kLongestInARow_s = 2.0 * kLongestHoldUp_s;
// What a network does to arrivals all the time; what is later than this says nothing of the sender's clock.
constexpr double kJitter_s = 0.006;
// A sample that comes by so much of an interval too early is not the next.
constexpr double kOutOfTurn = 0.5;
// A place tells that a sample was held up where none was lost fits by less than these shares, with its velocity and without, of what the
// gap does, and the gap fits no better than the motion is known: a share of the way of an interval, as jitter makes it, and of what
// accelerations make of it, less where the jerk is known.
constexpr double kClearWithVelocity = 0.5;
constexpr double kClear = 0.25;
constexpr double kDoubtOfWay = 0.3;
constexpr double kDoubtOfSpeeding = 0.2;
constexpr double kDoubtOfSpeedingWithJerk = 0.1;
// Of so many samples that are stamped the least of their intervals is the stream's: others were lost. Where a fifth is lost, all of six
// came after a loss once in 3000 samples, of twelve once in 50 million.
constexpr std::size_t kIntervals = 12;

}  // namespace

// Samples that were lost on the way leave whole intervals out; those that were held up do not. Where a sample lies tells which it is: it
// is the one that its motion brings nearest. Where that does not tell, they are lost until they come after all.
double StreamTarget::intervals_in(double gap, const StreamSample& sample) noexcept {
  if (counted_lost_ > 0 && gap < interval_ - std::max(kOutOfTurn * interval_, kJitter_s / period_s_)) {
    --counted_lost_;
    return 0.0;
  }
  const double most = std::max(1.0, std::round(gap / interval_));
  const double farthest = std::round((gap + 0.5 * kJitter_s / period_s_) / interval_);
  const bool short_gap = seconds(gap - interval_) <= kLongestHoldUp_s;
  const bool told = short_gap && farthest > 1.0 && past_count_ >= 2 && past_[0].velocity_rad_s != 0.0 &&
                    seconds(held_up_ * interval_) <= kLongestInARow_s;
  const double intervals = told ? nearest_of(most, farthest, sample) : most;
  held_up_ = intervals < most ? held_up_ + 1 : 0;
  counted_lost_ = short_gap ? static_cast<int>(intervals) - 1 : 0;
  return intervals;
}

// How many intervals, up to the `farthest`, the motion needs to get there; `most` if that is not clear.
double StreamTarget::nearest_of(double most, double farthest, const StreamSample& sample) const noexcept {
  const Knot& last = past_[0];
  const auto place_rad = [&](double n) {
    const double t = seconds(n * interval_);
    return last.position_rad +
           t * (last.velocity_rad_s + t * (0.5 * last.acceleration_rad_s2 + t * last.jerk_rad_s3 / 6.0));
  };
  const bool moving = sample.derivatives > 0 && last.moving;
  const auto off_rad = [&](double n) {
    const double position_off_rad = std::abs(place_rad(n) - sample.position_rad);
    if (!moving) return position_off_rad;
    const double t = seconds(n * interval_);
    const double velocity_rad_s =
        last.velocity_rad_s + t * (last.acceleration_rad_s2 + 0.5 * t * last.jerk_rad_s3);
    return position_off_rad + seconds(interval_) * std::abs(velocity_rad_s - sample.velocity_rad_s);
  };
  const double most_off_rad = off_rad(most);
  double intervals = most;
  double least_off_rad = most_off_rad;
  double way_rad = 0.0;
  for (double n = farthest; n >= 1.0; n -= 1.0) {
    way_rad = std::max(way_rad, std::abs(place_rad(n) - place_rad(n - 1.0)));
    const double n_off_rad = off_rad(n);
    if (n_off_rad >= least_off_rad) continue;
    least_off_rad = n_off_rad;
    intervals = n;
  }
  const double most_s = seconds(most * interval_);
  const double doubt_rad = std::min(kDoubtOfWay, kJitter_s / seconds(interval_)) * way_rad +
                           0.5 * (slow() ? kDoubtOfSpeedingWithJerk : kDoubtOfSpeeding) *
                               std::abs(last.acceleration_rad_s2) * most_s * most_s;
  const bool clear =
      most_off_rad > doubt_rad && least_off_rad < (moving ? kClearWithVelocity : kClear) * most_off_rad;
  return clear ? intervals : most;
}

void StreamTarget::clock_in(const StreamSample& sample) noexcept {
  ++arrivals_;
  const double gap = present() - arrival_;
  const bool at_once = arrivals_ > 1 && present() == came_;
  came_ = present();
  if (arrivals_ == 1) first_came_ = came_;
  // Among as many from the first on as one hold-up may hold, one a period, one that comes with the one before was held up: no interval is
  // known yet that could tell. Later, it may be one that was taken for lost.
  const bool among_first = arrivals_ <= kLongestHoldUp_s / period_s_;
  if (at_once && among_first && gap < kOutOfTurn * interval_) return clock_in_held_up();
  if (arrivals_ <= 2) {
    interval_ = arrivals_ == 2 ? std::max(gap, 1.0) : 0.0;
    arrival_ = present();
    counted_lost_ = 0;
    held_up_ = 0;
    return;
  }
  const double n = arrivals_;
  const double intervals = intervals_in(gap, sample);
  if (intervals == 0.0) return;
  // What was held up says nothing of the sender's clock.
  const double off = gap - intervals * interval_;
  const double late = held_up_ > 0 && seconds(off) > kJitter_s ? 0.0 : std::min(off, 0.5 * interval_);
  arrival_ +=
      intervals * interval_ + std::max(kLeastArrivalGain, 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0))) * late;
  interval_ += std::max(kLeastIntervalGain, 6.0 / (n * (n + 1.0))) * late / intervals;
  interval_ = std::max(interval_, 1.0);
}

// Nothing told yet that those before it had been held up: the last of them is on time, and takes the place of the one before.
void StreamTarget::clock_in_held_up() noexcept {
  interval_ = std::max(1.0, (came_ - first_came_) / (arrivals_ - 1));
  arrival_ = came_;
  counted_lost_ = 0;
  held_up_ = 0;
  if (past_count_ == 0 || past_[0].at < arrival_) return;
  std::copy(past_.begin() + 1, past_.end(), past_.begin());
  --past_count_;
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
  carried.at = std::max(knot.at + ahead, now_ + 1.0);
  carried.due = std::max(knot.at + least_ahead, now_ + 1.0);
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
  const Knot& before = waiting_.size() > 1 ? waiting_.last_but_one() : to_;
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

}  // namespace strainwave
