#include "control/stream_target.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {
// Before a second sample has shown the stream's rate.
constexpr double kFirstInterval_s = 0.01;
// The loop that is locked to the arrivals: its gains are those of a straight line through all of them, and then those that average
// over some forty.
constexpr double kLeastArrivalGain = 0.05;
constexpr double kLeastIntervalGain = 0.00125;
// An untimed knot lies at least so far ahead.
constexpr double kLeastAhead_s = 0.02;
constexpr double kLongestAhead_s = 0.1;
// Velocities are estimated from positions that are at least so far apart.
constexpr double kApart_s = 0.01;
// What is bridged when samples are missing.
constexpr double kBridgedIntervals = 3.0;
constexpr double kLongestBridge_s = 0.2;
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

// Multiple of a limit that a motion may need: one that needs more is a new place.
constexpr double kReach = 2.0;
// A velocity may differ from that of the positions by these shares of the limit and of itself, for what arrivals do to times, and by what
// the acceleration makes of it meanwhile.
constexpr double kDoubtOfLimit = 0.15;
constexpr double kDoubtOfItself = 0.5;
}  // namespace

void StreamTarget::begin(double position_rad, double velocity_rad_s) noexcept {
  now_ = 0.0;
  state_ = {position_rad, velocity_rad_s, 0.0};
  to_ = {0.0, position_rad, velocity_rad_s, 0.0};
  from_ = to_;
  waiting_count_ = 0;
  interval_ = 0.0;
  arrivals_ = 0;
  past_count_ = 0;
  ended_ = false;
}

// Whether the velocity that it gives is not that of its positions: in degrees, of another sign, or left over. Followed, it would take the
// joint away from every position that was sent.
bool StreamTarget::contradicts_itself(const Knot& knot) const noexcept {
  const Knot* last = before(knot.at);
  if (last == nullptr) return false;
  const double since_s = seconds(knot.at - last->at);
  const double mean_rad_s = (knot.position_rad - last->position_rad) / since_s;
  const double doubt_rad_s = kDoubtOfLimit * reach_.velocity_rad_s +
                             kDoubtOfItself * std::min(std::abs(knot.velocity_rad_s), std::abs(mean_rad_s));
  const double changed_rad_s = reach_.acceleration_rad_s2 * since_s;
  const double between_rad_s = 0.5 * (knot.sent_rad_s + last->sent_rad_s);
  return std::abs(knot.velocity_rad_s - mean_rad_s) > doubt_rad_s + changed_rad_s ||
         std::abs(between_rad_s - mean_rad_s) > doubt_rad_s + 0.5 * changed_rad_s;
}

void StreamTarget::take(const StreamSample& sent, const Reach& reach) noexcept {
  reach_ = reach;
  StreamSample sample = sent;
  Knot knot{now_, sample.position_rad, sample.velocity_rad_s, sample.acceleration_rad_s2};
  const double last_arrival = arrival_;
  if (sample.in_periods > 0) {
    knot.at += static_cast<double>(sample.in_periods);
  } else {
    clock_in();
    knot.at = arrival_;
  }
  // What is not newer than the last has nothing to add.
  if (past_count_ > 0 && knot.at <= past_[0].at) return;
  if (past_count_ > 0 && seconds(knot.at - past_[0].at) > kLongestBridge_s) past_count_ = 0;
  knot.sent_rad_s = sample.velocity_rad_s;
  if (sample.derivatives > 0 && contradicts_itself(knot)) sample.derivatives = 0;
  estimate_derivatives(sample, knot);
  remember(knot);
  if (sample.in_periods > 0) return queue(knot);
  waiting_count_ = 0;
  lead_to(carried_forward(sample, knot, arrivals_ > 1 ? arrival_ - last_arrival : 0.0));
}

// Samples that were lost on the way leave whole intervals out.
void StreamTarget::clock_in() noexcept {
  ++arrivals_;
  const double gap = now_ - arrival_;
  if (arrivals_ <= 2) {
    interval_ = arrivals_ == 2 ? std::max(gap, 1.0) : 0.0;
    arrival_ = now_;
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
}

// The newest sample that is kApart_s older than `period`, or the oldest that there is.
const StreamTarget::Knot* StreamTarget::before(double period) const noexcept {
  const Knot* found = nullptr;
  for (std::size_t i = 0; i < past_count_; ++i) {
    if (past_[i].at >= period) continue;
    found = &past_[i];
    if (seconds(period - found->at) >= kApart_s - 0.5 * period_s_) break;
  }
  return found;
}

void StreamTarget::estimate_derivatives(const StreamSample& sample, Knot& knot) noexcept {
  const Knot* last = before(knot.at);
  const Knot* first = last != nullptr ? before(last->at) : nullptr;
  if (sample.derivatives < 2) knot.acceleration_rad_s2 = 0.0;
  if (sample.derivatives < 1) knot.velocity_rad_s = 0.0;
  if (last == nullptr) return;
  if (sample.derivatives == 0) return derive_from_positions(*last, first, knot);
  const double newer_s = seconds(knot.at - last->at);
  if (sample.derivatives == 2) {
    knot.jerk_rad_s3 = (knot.acceleration_rad_s2 - last->acceleration_rad_s2) / newer_s;
    return;
  }
  // Slope of a parabola through three velocities, or of a line through two.
  knot.acceleration_rad_s2 = (knot.velocity_rad_s - last->velocity_rad_s) / newer_s;
  if (first == nullptr) return;
  const double older_s = seconds(last->at - first->at);
  const double older_rad_s2 = (last->velocity_rad_s - first->velocity_rad_s) / older_s;
  const Slope slope = slope_at_newest(knot.acceleration_rad_s2, newer_s, older_rad_s2, older_s);
  knot.acceleration_rad_s2 = slope.rate;
  knot.jerk_rad_s3 = slope.change;
}

// Likewise. What needs more acceleration than can be is a place: nothing before it says anything about a motion.
void StreamTarget::derive_from_positions(const Knot& last, const Knot* first, Knot& knot) noexcept {
  const bool stands = past_count_ >= 2 && knot.position_rad == past_[0].position_rad &&
                      knot.position_rad == past_[1].position_rad && knot.position_rad == last.position_rad;
  if (stands) return;
  const double newer_s = seconds(knot.at - last.at);
  const double newer_rad_s = (knot.position_rad - last.position_rad) / newer_s;
  if (first == nullptr) {
    const double possible = kReach * reach_.acceleration_rad_s2 * newer_s;
    if (std::abs(newer_rad_s - state_.velocity_rad_s) <= possible) knot.velocity_rad_s = newer_rad_s;
    return;
  }
  const double older_s = seconds(last.at - first->at);
  const double older_rad_s = (last.position_rad - first->position_rad) / older_s;
  const Slope slope = slope_at_newest(newer_rad_s, newer_s, older_rad_s, older_s);
  if (std::abs(slope.change) > kReach * reach_.acceleration_rad_s2) {
    past_count_ = 0;
    return;
  }
  knot.velocity_rad_s = slope.rate;
  knot.acceleration_rad_s2 = slope.change;
}

// Farther after a gap, so that what was missed is caught up with in the time that it took.
StreamTarget::Knot StreamTarget::carried_forward(const StreamSample& sample, const Knot& knot,
                                                 double since_last) const noexcept {
  const double interval = interval_ > 0.0 ? interval_ : kFirstInterval_s / period_s_;
  const double ahead =
      std::max({interval, kLeastAhead_s / period_s_, std::min(since_last, kLongestAhead_s / period_s_)});
  const double lag = sample.derivatives == 0 ? interval : 0.0;
  const double carried_s = knot.velocity_rad_s == 0.0 ? 0.0 : seconds(ahead - lag);
  // The jerk matters to slow streams; in fast ones it would be their noise.
  const double jerk_rad_s3 = ahead <= interval ? knot.jerk_rad_s3 : 0.0;
  Knot carried = knot;
  carried.at = std::max(knot.at + ahead, now_ + 1.0);
  carried.acceleration_rad_s2 += carried_s * jerk_rad_s3;
  carried.velocity_rad_s += carried_s * (knot.acceleration_rad_s2 + 0.5 * carried_s * jerk_rad_s3);
  carried.position_rad +=
      carried_s *
      (knot.velocity_rad_s + carried_s * (0.5 * knot.acceleration_rad_s2 + carried_s * jerk_rad_s3 / 6.0));
  return carried;
}

void StreamTarget::queue(const Knot& knot) noexcept {
  interval_ = past_count_ >= 2 ? past_[0].at - past_[1].at : knot.at - now_;
  arrivals_ = 0;
  if (now_ >= to_.at && waiting_count_ == 0) return lead_to(knot);
  if (waiting_count_ == kKnots) return;  // the sender is too far ahead; the knots it sends later will do
  waiting_[waiting_count_] = knot;
  ++waiting_count_;
}

void StreamTarget::lead_to(const Knot& knot) noexcept {
  from_ = {now_, state_.position_rad, state_.velocity_rad_s, state_.acceleration_rad_s2, 0.0};
  to_ = knot;
  const double duration_s = seconds(to_.at - from_.at);
  if (std::abs(to_.position_rad - from_.position_rad) <= kReach * reach_.velocity_rad_s * duration_s) return;
  // A new place: the target passes through the knot at its speed as if it always had.
  to_.acceleration_rad_s2 = 0.0;
  from_ = to_;
  from_.at = now_;
  from_.position_rad -= duration_s * to_.velocity_rad_s;
  state_ = {from_.position_rad, from_.velocity_rad_s, 0.0};
}

MovingTarget StreamTarget::step() noexcept {
  const State begin = state_;
  state_ = at(now_ + 1.0);
  now_ += 1.0;
  return {begin.position_rad, begin.velocity_rad_s, state_.position_rad, state_.velocity_rad_s};
}

StreamTarget::State StreamTarget::at(double period) noexcept {
  while (period > to_.at && waiting_count_ > 0) {
    from_ = to_;
    to_ = waiting_[0];
    std::copy(waiting_.begin() + 1, waiting_.begin() + static_cast<std::ptrdiff_t>(waiting_count_),
              waiting_.begin());
    --waiting_count_;
  }
  return period <= to_.at ? between(period) : beyond(period);
}

StreamTarget::State StreamTarget::between(double period) const noexcept {
  if (period >= to_.at) return {to_.position_rad, to_.velocity_rad_s, to_.acceleration_rad_s2};
  const double T = seconds(to_.at - from_.at);
  const double s = (period - from_.at) / (to_.at - from_.at);
  // p = p0 + c1 s + c2 s^2 + c3 s^3 + c4 s^4 + c5 s^5
  const double c1 = T * from_.velocity_rad_s;
  const double c2 = 0.5 * T * T * from_.acceleration_rad_s2;
  const double way = to_.position_rad - from_.position_rad - c1 - c2;
  const double slope = T * to_.velocity_rad_s - c1 - 2.0 * c2;
  const double bend = T * T * to_.acceleration_rad_s2 - 2.0 * c2;
  const double c3 = 10.0 * way - 4.0 * slope + 0.5 * bend;
  const double c4 = -15.0 * way + 7.0 * slope - bend;
  const double c5 = 6.0 * way - 3.0 * slope + 0.5 * bend;
  return {from_.position_rad + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
          (c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / T,
          (2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))) / (T * T)};
}

// As it was: with its acceleration for one interval, and then with the velocity that this gave.
StreamTarget::State StreamTarget::beyond(double period) noexcept {
  const double interval_s = interval_ > 0.0 ? seconds(interval_) : kFirstInterval_s;
  const double since_s = seconds(period - to_.at);
  const double speeding_s = std::min(since_s, interval_s);
  const double velocity_rad_s = to_.velocity_rad_s + speeding_s * to_.acceleration_rad_s2;
  if (to_.velocity_rad_s == 0.0) return {to_.position_rad, 0.0, 0.0};
  if (since_s > std::min(kBridgedIntervals * interval_s, kLongestBridge_s)) ended_ = true;
  return {to_.position_rad + 0.5 * (to_.velocity_rad_s + velocity_rad_s) * speeding_s +
              velocity_rad_s * (since_s - speeding_s),
          velocity_rad_s, since_s < interval_s ? to_.acceleration_rad_s2 : 0.0};
}

}  // namespace strainwave
