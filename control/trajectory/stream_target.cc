#include "control/trajectory/stream_target.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strainwave {

namespace {
// Before a second sample has shown the stream's rate.
constexpr double kFirstInterval_s = 0.01;
// An untimed knot lies at least so far ahead.
constexpr double kLeastAhead_s = 0.02;
// What is bridged when samples are missing.
constexpr double kBridgedIntervals = 2.0;
// A motion is smooth whose acceleration changes by no more than this share of the limit from one sample to the next.
constexpr double kSmooth = 0.1;
// For so long a smooth motion's acceleration goes on, or until it would have changed by that share.
constexpr double kSmoothIntervals = 2.5;
constexpr double kSmooth_s = 0.06;
// By so much of an interval a sample is late before it is missing.
constexpr double kLate = 0.5;
constexpr double kLongestBridge_s = 0.2;
// Share of the room beyond the samples, but for what the lead takes, in which a target is back.
constexpr double kBack = 0.5;
// Far below any encoder's count.
constexpr double kRounding_rad = 1e-9;
}  // namespace

void StreamTarget::begin(double position_rad, double velocity_rad_s, double lead_periods,
                         const ToldLoad& load) noexcept {
  lead_ = lead_periods;
  now_ = lead_periods;
  mean_s_ = 0.0;
  state_ = {position_rad, velocity_rad_s, 0.0};
  load_ = load_from_ = load_to_ = load;
  load_from_at_ = now_;
  load_to_at_ = now_;
  to_ = {now_, position_rad, velocity_rad_s, 0.0};
  to_.due = now_;
  from_ = to_;
  waiting_.clear();
  interval_ = 0.0;
  arrivals_ = 0;
  usual_gap_.forget();
  sender_.forget();
  untold_ = false;
  out_of_rhythm_ = 0.0;
  later_ = false;
  in_rhythm_ = false;
  caught_up_at_ = now_;
  past_count_ = left_behind_ = 0;
  nodes_.forget();
  fit_.forget();
  doubted_ = 0;
  missed_ = false;
  ended_ = false;
}

void StreamTarget::resume(double position_rad, double velocity_rad_s, const ToldLoad& load) noexcept {
  missed_ = true;
  state_ = {position_rad, velocity_rad_s, 0.0};
  load_ = load;
  // A sample that is late has nothing to add: then it ends again at once.
  to_ = {now_, position_rad, velocity_rad_s, 0.0};
  to_.carried = true;
  to_.due = now_ - kLongestBridge_s / period_s_;
  ended_ = false;
}

void StreamTarget::take(const StreamSample& sent, const Reach& reach) noexcept {
  reach_ = reach;
  StreamSample sample = sent;
  Knot knot{present(), sample.position_rad, sample.velocity_rad_s, sample.acceleration_rad_s2};
  if (sample.in_periods > 0) {
    knot.at += static_cast<double>(sample.in_periods);
  } else {
    time(sample, knot);
  }
  knot.stamped = sample.in_periods > 0;
  if (knot.stamped) withdraw_from(knot.at);
  // What is not newer than the last has nothing to add.
  if (past_count_ > 0 && knot.at <= past_[0].at) return;
  if (waiting_.empty() && begins() > to_.at && !to_.rests()) missed_ = true;
  if (std::exchange(missed_, false) && past_count_ > 0) catch_up_in(knot.at - past_[0].at);
  if (past_count_ > 0 && seconds(knot.at - past_[0].at) > kLongestBridge_s)
    left_behind_ = std::exchange(past_count_, 0);
  const double apart_s = sample.derivatives == 0 && sample.in_periods == 0 && (!knot.told || in_rhythm_)
                             ? 2.0 * kApart_s
                             : kApart_s;
  const Knot* last = sample_before(knot.at, apart_s);
  const Before before{last, last != nullptr ? sample_before(last->at, apart_s) : nullptr};
  mean_s_ = last != nullptr ? seconds(knot.at - last->at) : 0.0;
  mean_rad_s_ = last != nullptr ? (knot.position_rad - last->position_rad) / mean_s_ : 0.0;
  knot.due = knot.at;
  knot.sent_ahead = knot.at - present() - lead_;
  knot.load = sample.load;
  knot.sent_rad_s = sample.velocity_rad_s;
  if (sample.derivatives > 0 && !sample.computed_here && !believes(knot, before)) sample.derivatives = 0;
  if (sample.derivatives == 2) {
    const double mean_rad_s2 = last != nullptr ? (knot.velocity_rad_s - last->velocity_rad_s) / mean_s_ : 0.0;
    if (std::abs(knot.acceleration_rad_s2 - mean_rad_s2) > reach_.acceleration_rad_s2) sample.derivatives = 1;
  }
  knot.moving = sample.derivatives > 0;
  estimate_derivatives(sample, before, knot);
  knot.smooth =
      before.first != nullptr && std::abs(knot.jerk_rad_s3) * mean_s_ <= kSmooth * reach_.acceleration_rad_s2;
  remember(knot);
  if (sample.in_periods > 0) return queue(sample, knot);
  waiting_.clear();
  const double ahead = lead_ + least_ahead();
  lead_to(carried_forward(sample, knot, ahead, ahead));
}

// Between samples, in periods.
double StreamTarget::expected_interval() const noexcept {
  return interval_ > 0.0 ? interval_ : kFirstInterval_s / period_s_;
}

// By how much a knot lies ahead of now at least.
double StreamTarget::least_ahead() const noexcept {
  return std::max(expected_interval(), kLeastAhead_s / period_s_);
}

// Whatever comes meanwhile.
void StreamTarget::catch_up_in(double periods) noexcept {
  caught_up_at_ = std::max(caught_up_at_, begins() + std::min(periods, kLongestBridge_s / period_s_));
}

double StreamTarget::way_ahead_rad() const noexcept {
  const Knot& last = waiting_.empty() ? to_ : waiting_.last();
  const double way_rad = last.position_rad - state_.position_rad;
  if (!last.moving) return way_rad;
  return way_rad + kLeastAhead_s * (last.velocity_rad_s + 0.5 * kLeastAhead_s * last.acceleration_rad_s2);
}

// What comes to rest where it is told to rest again does so: begun anew with each sample it would never be there, and what rounding leaves
// of its velocity would turn friction round.
void StreamTarget::lead_to(const Knot& knot) noexcept {
  lead_load_to(knot);
  if (knot.carried && knot.rests() && to_.rests() && knot.position_rad == to_.position_rad) return;
  if (knot.rests() && rests_at(knot)) state_ = {knot.position_rad, 0.0, 0.0};
  from_ = {now_, state_.position_rad, state_.velocity_rad_s, state_.acceleration_rad_s2};
  to_ = knot;
  const double duration_s = seconds(to_.at - from_.at);
  const bool near =
      std::abs(to_.position_rad - from_.position_rad) <= kReach * reach_.velocity_rad_s * duration_s;
  if (near && !(alone() && hurries())) return;
  // A new place: the target passes through the knot at its speed as if it always had.
  to_.acceleration_rad_s2 = 0.0;
  from_ = to_;
  from_.at = now_;
  from_.position_rad -= duration_s * to_.velocity_rad_s;
  state_ = {from_.position_rad, from_.velocity_rad_s, 0.0};
}

// To a rest from a motion that there is no time to end: a move does so better.
bool StreamTarget::hurries() const noexcept {
  constexpr int kParts = 8;
  if (!to_.rests()) return false;
  for (int part = 0; part < kParts; ++part) {
    const double at = from_.at + (to_.at - from_.at) * part / kParts;
    if (std::abs(between(at).acceleration_rad_s2) > reach_.acceleration_rad_s2) return true;
  }
  return false;
}

// But for what rounding, and a way that was begun anew time and again, leave of it.
bool StreamTarget::rests_at(const Knot& knot) const noexcept {
  const double left_s = seconds(knot.at - now_);
  const double velocity_rad_s = state_.velocity_rad_s + left_s * state_.acceleration_rad_s2;
  return std::abs(knot.position_rad - state_.position_rad) <= kRounding_rad &&
         left_s * std::max(std::abs(state_.velocity_rad_s), std::abs(velocity_rad_s)) <= kRounding_rad;
}

MovingTarget StreamTarget::step() noexcept {
  const State begin = state_;
  state_ = at(now_ + 1.0);
  now_ += 1.0;
  left_out_ = std::max(0.0, left_out_ - 1.0);
  load_ = load_at(now_);
  return {begin.position_rad, begin.velocity_rad_s, state_.position_rad, state_.velocity_rad_s, load_};
}

// Whether it has ended, the next step() says: a sample that has come meanwhile may be taken before.
void StreamTarget::skip(std::int64_t periods) noexcept {
  const bool ended = ended_;
  now_ += static_cast<double>(periods);
  left_out_ = 0.0;
  state_ = at(now_);
  if (to_.velocity_rad_s != 0.0) state_ = at(std::min(now_, to_.due + longest_bridge_s() / period_s_));
  ended_ = ended;
  load_ = load_at(now_);
}

// Where the samples are: the last ones, and all that lie ahead.
StreamTarget::Hull StreamTarget::known() const noexcept {
  Hull hull = hull_;
  if (waiting_.empty()) return hull;
  hull.widen(waiting_.hull());
  if (!to_.carried) hull.widen(to_);
  return hull;
}

MovingTarget StreamTarget::confined(const MovingTarget& target, double position_rad, double velocity_rad_s,
                                    Confinement& way) const noexcept {
  const int moves = (velocity_rad_s > 0.0) - (velocity_rad_s < 0.0);
  const int out = way != 0 ? way : moves;
  // The motion to one sample ends there by itself.
  if (past_count_ < 2 || out == 0) {
    way = 0;
    return target;
  }
  // Where the motion was carried on, and until it has caught up, it has the speed that its acceleration made of the samples'.
  const bool carried = now_ < caught_up_at_ || (to_.carried && to_.smooth);
  const double carried_rad_s = now_ > to_.at ? std::abs(target.velocity_rad_s)
                               : carried     ? std::abs(to_.velocity_rad_s)
                                             : 0.0;
  const Hull known = this->known();
  const double fastest_rad_s = std::min(std::max(known.fastest_rad_s, carried_rad_s), reach_.velocity_rad_s);
  const double since_s = std::max(0.0, seconds(std::max(now_, caught_up_at_) - past_[0].at));
  // Who catches up with the target is faster than it, and brakes to its speed only.
  const double speed_rad_s = std::max(0.0, out * velocity_rad_s);
  const double with_rad_s = std::clamp(out * target.velocity_rad_s, 0.0, speed_rad_s);
  const double braking_rad2_s2 =
      std::max(fastest_rad_s * fastest_rad_s, with_rad_s * (2.0 * speed_rad_s - with_rad_s));
  const double room_rad = fastest_rad_s * (since_s + std::max(0.5 * seconds(interval_), kApart_s)) +
                          0.5 * braking_rad2_s2 / reach_.acceleration_rad_s2;
  const double rest_rad = position_rad + 0.5 * velocity_rad_s * speed_rad_s / reach_.acceleration_rad_s2;
  const double edge_rad = out > 0 ? known.high_rad : known.low_rad;
  // A target that is still out there would be left and gone after again, in turns. By its lead it always is.
  const double led_rad = fastest_rad_s * std::min(since_s, seconds(lead_));
  const bool beyond = out * (target.next_position_rad - edge_rad) - led_rad > kBack * (room_rad - led_rad);
  if (moves == out && out * (rest_rad - edge_rad) > room_rad)
    way = out;
  else if (!beyond)
    way = 0;
  if (way == 0) return target;
  return {edge_rad, 0.0, edge_rad, 0.0, target.load};
}

StreamTarget::State StreamTarget::at(double period) noexcept {
  while (period > to_.at && !waiting_.empty()) {
    from_ = to_;
    to_ = waiting_.pop();
    load_from_ = load_to_;
    load_to_ = to_.load;
    load_from_at_ = from_.at;
    load_to_at_ = to_.at;
  }
  ended_ = ended_ || (to_.velocity_rad_s != 0.0 && seconds(period - to_.due) > longest_bridge_s());
  return period <= to_.at ? between(period) : beyond(period);
}

double StreamTarget::longest_bridge_s() const noexcept {
  const double interval_s = seconds(expected_interval());
  return std::min(std::max(bridge_s_, kBridgedIntervals * interval_s) + kLate * interval_s, kLongestBridge_s);
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

// As it was: with its acceleration for an interval, or where it is smooth for as long as samples may be missing, and then with the velocity
// that this gave.
StreamTarget::State StreamTarget::beyond(double period) const noexcept {
  if (to_.velocity_rad_s == 0.0) return {to_.position_rad, 0.0, 0.0};
  const double since_s = seconds(period - to_.at);
  const double interval_s = seconds(expected_interval());
  const double goes_on_s =
      to_.smooth
          ? std::max(kSmoothIntervals * interval_s,
                     std::min(kSmooth_s, kSmooth * reach_.acceleration_rad_s2 / std::abs(to_.jerk_rad_s3)))
          : interval_s;
  const double speeding_s = std::min(since_s, goes_on_s);
  const double jerk_rad_s3 = carried_on_jerk_rad_s3(to_);
  const double velocity_rad_s =
      to_.velocity_rad_s + speeding_s * (to_.acceleration_rad_s2 + 0.5 * speeding_s * jerk_rad_s3);
  return {to_.position_rad +
              speeding_s * (to_.velocity_rad_s +
                            speeding_s * (0.5 * to_.acceleration_rad_s2 + speeding_s * jerk_rad_s3 / 6.0)) +
              velocity_rad_s * (since_s - speeding_s),
          velocity_rad_s, since_s <= speeding_s ? to_.acceleration_rad_s2 + speeding_s * jerk_rad_s3 : 0.0};
}

}  // namespace strainwave
