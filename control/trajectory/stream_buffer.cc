// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/stream_buffer.h"

#include <algorithm>
#include <cmath>

#include "control/trajectory/local_polynomial.h"

namespace strainwave {

namespace {

// Least duration of a segment of the motion: in a shorter one, errors of a sample's time would cause jerk.
constexpr double kSegment_s = 0.02;
// Longest time for catching up after a gap. Samples farther apart do not determine derivatives of each other.
constexpr double kLongest_s = 0.2;
// Least time between neighbours for a derivative, since it divides their rounding.
constexpr double kApart_s = 0.01;
constexpr int kBefore = 8;  ///< neighbours before the sample
constexpr int kAfter = 2;   ///< neighbours after it
// A jerk that changes the acceleration by less than this share of the limit in an interval is motion; a larger one is noise of the positions.
constexpr double kSmooth = 0.1;
// How long the jerk of a smooth motion is extrapolated: in intervals, and at least in seconds.
constexpr double kCarriedIntervals = 2.5;
constexpr double kCarried_s = 0.06;
// A sample beyond this multiple of the joint's limits belongs to no motion.
constexpr double kNewPlace = 2.0;
// A velocity contradicts if it differs from the positions by more than this share of the mean of both, plus some counts.
constexpr double kContradicts = 0.5;
constexpr double kContradictsCounts = 3.0;
constexpr double kContradicts_s = 0.025;  // longer than a burst of delayed samples
// A motion this close to its end has arrived: far below an encoder's count, and without effect on the torque.
constexpr double kAtRest_rad = 1e-9;
constexpr double kAtRest_rad_s = 1e-6;
// Each is the derivative of the one before.
constexpr std::array kParts{&MotionPoint::position_rad, &MotionPoint::velocity_rad_s,
                            &MotionPoint::acceleration_rad_s2, &MotionPoint::jerk_rad_s3};

// Replanning again and again would bring the motion near its place, but never to it.
bool has_come_to(const MotionPoint& place, const MotionPoint& now) noexcept {
  return place.velocity_rad_s == 0.0 && place.acceleration_rad_s2 == 0.0 &&
         std::abs(now.position_rad - place.position_rad) <= kAtRest_rad &&
         std::abs(now.velocity_rad_s) <= kAtRest_rad_s;
}

}  // namespace

void StreamBuffer::begin(double position_rad, double velocity_rad_s, double lead_periods,
                         const StreamLoad& load) noexcept {
  count_ = 0;
  lead_ = lead_periods;
  origin_ = 0.0;
  interval_ = 10.0;
  sender_.forget();
  resume(position_rad, velocity_rad_s, load);
}

void StreamBuffer::resume(double position_rad, double velocity_rad_s, const StreamLoad& load) noexcept {
  state_ = {play(), {position_rad, velocity_rad_s, 0.0, 0.0}, load};
  from_ = to_ = anchor_ = state_;
  ended_ = false;
}

std::size_t StreamBuffer::first_from(double at) const noexcept {
  std::size_t low = 0;
  std::size_t high = count_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (knot(middle).at < at)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}

// A new sample replaces all samples that are for its instant or later.
void StreamBuffer::insert(Knot knot) noexcept {
  while (count_ > 0 && last().at >= knot.at) --count_;
  if (count_ > 0) {
    interval_ = std::clamp(knot.at - last().at, 1.0, 1.5 * interval_ + 5.0);
    knot.new_place = is_new_place(knot);
    knot.contradicts = knot.is_contradicted_by(last(), config_);
    if (!knot.contradicts || !last().contradicts) contradicts_from_ = knot.at;
  }
  if (count_ == kSamples) {
    first_ = (first_ + 1) % kSamples;
    --count_;
  }
  knots_[(first_ + count_++) % kSamples] = knot;
}

bool StreamBuffer::is_new_place(const Knot& knot) const noexcept {
  const auto before = [&](double at) -> const Knot* {
    const std::size_t i = first_from(at - (kApart_s / config_.period_s - 0.5));
    return i > 0 ? &this->knot(i - 1) : nullptr;
  };
  const Knot* one = before(knot.at);
  if (one == nullptr || seconds(knot.at - one->at) > kLongest_s) return false;
  const double apart_s = seconds(knot.at - one->at);
  const double speed_rad_s = (knot.state.position_rad - one->state.position_rad) / apart_s;
  if (std::abs(speed_rad_s) > kNewPlace * reach_.velocity_rad_s) return true;
  const Knot* two = before(one->at);
  if (two == nullptr || seconds(one->at - two->at) > kLongest_s) return false;
  const double before_s = seconds(one->at - two->at);
  const double before_rad_s = (one->state.position_rad - two->state.position_rad) / before_s;
  return std::abs(speed_rad_s - before_rad_s) >
         kNewPlace * reach_.acceleration_rad_s2 * 0.5 * (apart_s + before_s);
}

StreamBuffer::Way StreamBuffer::Knot::way_since(const Knot& before, double period_s) const noexcept {
  return {state.position_rad - before.state.position_rad,
          0.5 * period_s * (at - before.at) * (before.state.velocity_rad_s + state.velocity_rad_s)};
}

bool StreamBuffer::Knot::is_contradicted_by(const Knot& before, const StreamConfig& config) const noexcept {
  const bool told = derivatives > 0 && before.derivatives > 0 && !new_place;
  if (!told || config.period_s * (at - before.at) > kLongest_s) return false;
  const auto [shown_rad, told_rad] = way_since(before, config.period_s);
  const double missed_rad = std::abs(shown_rad - told_rad) - kContradictsCounts * config.count_rad;
  return missed_rad > kContradicts * 0.5 * (std::abs(shown_rad) + std::abs(told_rad));
}

double StreamBuffer::velocity_ratio() const noexcept {
  const auto [shown_rad, told_rad] =
      count_ > 1 ? last().way_since(knot(count_ - 2), config_.period_s) : Way{};
  return std::abs(shown_rad) > kContradictsCounts * config_.count_rad ? told_rad / shown_rad : 0.0;
}

SampleFate StreamBuffer::take(const StreamSample& sample, const MotionLimits& reach) noexcept {
  reach_ = reach;
  reach_.acceleration_rad_s2 = std::min(reach.acceleration_rad_s2, reach.deceleration_rad_s2);
  const double came = now_ + left_out_;
  Knot knot{came + static_cast<double>(sample.in_periods),
            {sample.position_rad, sample.derivatives > 0 ? sample.velocity_rad_s : 0.0,
             sample.derivatives > 1 ? sample.acceleration_rad_s2 : 0.0, 0.0},
            sample.load,
            sample.derivatives};
  if (sample.in_periods <= 0) {
    sender_.take(sample.sent_us, came);
    origin_ = sender_.offset() + config_.delay_s / config_.period_s;
    knot.at = sender_.sent();
  }
  const bool late = knot.at < play() + left_out_;
  insert(knot);
  lead_on();
  // A burst of delayed samples also contradicts, but not for long.
  const bool for_long = seconds(last().at - contradicts_from_) >= kContradicts_s;
  if (last().contradicts && for_long) return SampleFate::kVelocitiesContradict;
  return late ? SampleFate::kLate : SampleFate::kInTime;
}

// Plans from here to the first sample that is a segment ahead, or to where the motion of the last sample will be by then.
void StreamBuffer::lead_on() noexcept {
  const double now = play();
  const double missed_s = std::clamp(seconds(now - to_.at), kSegment_s, kLongest_s);
  if (now > to_.at && state_.state.velocity_rad_s != 0.0) caught_up_at_ = now_ + missed_s / config_.period_s;
  const double until = now + std::max(kSegment_s / config_.period_s, caught_up_at_ - now_);
  anchor_ = derived(std::min(first_from(until), count_ - 1));
  state_.at = now;
  if (has_come_to(anchor_.state, state_.state)) state_.state = anchor_.state;
  from_ = state_;
  to_ = anchor_;
  to_.at = std::max(anchor_.at, until);
  to_.state = carried(to_.at);
}

// A position that came three times, over at least the time of a segment, is a place, and does not belong to the motion before it.
bool StreamBuffer::stands(std::size_t i) const noexcept {
  const Knot& one = knot(i);
  if (one.derivatives > 0) return false;
  for (std::size_t k = i; k > 0 && knot(k - 1).state.position_rad == one.state.position_rad; --k)
    if (k < i && seconds(one.at - knot(k - 1).at) >= kSegment_s - 0.5 * config_.period_s) return true;
  return false;
}

void StreamBuffer::fit_neighbours(std::size_t i, LocalPolynomial& fit) const noexcept {
  const Knot& one = knot(i);
  const auto value = [part = kParts[one.believed()]](const Knot& of) { return of.state.*part; };
  double latest = one.at;
  const auto add = [&](const Knot& other) {
    const double apart_s = seconds(std::abs(other.at - latest));
    if (apart_s < kApart_s - 0.5 * config_.period_s || apart_s > kLongest_s) return 0;
    fit.add(seconds(other.at - one.at), value(other) - value(one));
    latest = other.at;
    return 1;
  };
  int added = 0;
  for (std::size_t k = i + 1; k < count_ && added < kAfter && !knot(k).new_place; ++k) added += add(knot(k));
  latest = one.at;
  added = 0;
  for (std::size_t k = i; k > 0 && added < kBefore && !knot(k).new_place; --k) added += add(knot(k - 1));
}

// Completes the sample with the derivatives that were not sent.
StreamBuffer::Knot StreamBuffer::derived(std::size_t i) const noexcept {
  Knot one = knot(i);
  if (stands(i)) return one;
  LocalPolynomial fit;
  fit_neighbours(i, fit);
  MotionPoint& state = one.state;
  std::size_t part = one.believed();
  for (const double derivative : fit.derivatives())
    if (++part < kParts.size()) state.*kParts[part] = derivative;
  state.velocity_rad_s = std::clamp(state.velocity_rad_s, -reach_.velocity_rad_s, reach_.velocity_rad_s);
  state.acceleration_rad_s2 =
      std::clamp(state.acceleration_rad_s2, -reach_.acceleration_rad_s2, reach_.acceleration_rad_s2);
  return one;
}

// Extrapolates from the anchor: with its acceleration for some time, then at constant velocity.
MotionPoint StreamBuffer::carried(double at) const noexcept {
  const MotionPoint& s = anchor_.state;
  const double interval_s = seconds(interval_);
  const bool smooth = std::abs(s.jerk_rad_s3) * interval_s <= kSmooth * reach_.acceleration_rad_s2;
  const double jerk = smooth ? s.jerk_rad_s3 : 0.0;
  const double since_s = seconds(at - anchor_.at);
  const double t =
      std::min(since_s, smooth ? std::max(kCarriedIntervals * interval_s, kCarried_s) : interval_s);
  const double acceleration = s.acceleration_rad_s2 + t * jerk;
  const double velocity = s.velocity_rad_s + t * (s.acceleration_rad_s2 + 0.5 * t * jerk);
  const double position =
      s.position_rad + t * (s.velocity_rad_s + t * (0.5 * s.acceleration_rad_s2 + t * jerk / 6.0));
  return {position + (since_s - t) * velocity, velocity, since_s > t ? 0.0 : acceleration, 0.0};
}

MotionPoint StreamBuffer::between(double at) const noexcept {
  const double T = seconds(to_.at - from_.at);
  const double s = (at - from_.at) / (to_.at - from_.at);
  const MotionPoint& f = from_.state;
  const MotionPoint& g = to_.state;
  const double c1 = T * f.velocity_rad_s;
  const double c2 = 0.5 * T * T * f.acceleration_rad_s2;
  const double way = g.position_rad - f.position_rad - c1 - c2;
  const double slope = T * g.velocity_rad_s - c1 - 2.0 * c2;
  const double bend = T * T * g.acceleration_rad_s2 - 2.0 * c2;
  const double c3 = 10.0 * way - 4.0 * slope + 0.5 * bend;
  const double c4 = -15.0 * way + 7.0 * slope - bend;
  const double c5 = 6.0 * way - 3.0 * slope + 0.5 * bend;
  return {f.position_rad + s * (c1 + s * (c2 + s * (c3 + s * (c4 + s * c5)))),
          (c1 + s * (2.0 * c2 + s * (3.0 * c3 + s * (4.0 * c4 + s * 5.0 * c5)))) / T,
          (2.0 * c2 + s * (6.0 * c3 + s * (12.0 * c4 + s * 20.0 * c5))) / (T * T), 0.0};
}

// Linear between samples; the last load stays.
StreamLoad StreamBuffer::load_at(double at) const noexcept {
  const std::size_t next = first_from(at);
  if (next == count_) return count_ > 0 ? last().load : state_.load;
  const Knot& before = next > 0 ? knot(next - 1) : from_;
  const Knot& after = knot(next);
  if (before.at >= after.at) return after.load;
  const double share = std::clamp((at - before.at) / (after.at - before.at), 0.0, 1.0);
  return {before.load.torque_Nm + share * (after.load.torque_Nm - before.load.torque_Nm),
          before.load.inertia_kgm2 + share * (after.load.inertia_kgm2 - before.load.inertia_kgm2)};
}

void StreamBuffer::move_to(double at) noexcept {
  const bool on_segment = at < to_.at;
  state_.state = on_segment ? between(at) : carried(at);
  state_.load = load_at(at);
  const double silent = at - (count_ > 0 ? std::max(last().at, anchor_.at) : at);
  const double wanted = std::max(config_.bridge_s / config_.period_s, 2.0 * interval_) + 0.5 * interval_;
  const double bridged = std::min(wanted, kLongest_s / config_.period_s);
  if (state_.state.velocity_rad_s != 0.0 && silent > bridged) ended_ = true;
}

MovingTarget StreamBuffer::step() noexcept {
  const MotionPoint begin = state_.state;
  if (play() >= to_.at && count_ > 0 && last().at > play()) lead_on();
  now_ += 1.0;
  left_out_ = std::max(0.0, left_out_ - 1.0);
  move_to(play());
  const MotionPoint& end = state_.state;
  return {begin.position_rad, begin.velocity_rad_s, end.position_rad, end.velocity_rad_s, state_.load};
}

}  // namespace strainwave
