// Which instant a sample of StreamTarget is for that is not stamped.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "control/trajectory/stream_target.h"

namespace strainwave {

namespace {

// The loop that is locked to the arrivals: its gains are those of a straight line through all of them, and then those that average
// over some forty.
constexpr double kLeastArrivalGain = 0.05;
constexpr double kLeastIntervalGain = 0.00125;
// Of so many arrivals on, one alone that is so much later says nothing either.
constexpr int kLocked = 10;
// For longer than this nobody is held up, and no motion goes on as it was.
constexpr double kLongestHoldUp_s = 0.06;
// If those of so long a time were all held up, it was others that were lost before them.
constexpr double kLongestInARow_s = 2.0 * kLongestHoldUp_s;
// What a network does to arrivals all the time; what is later than this says nothing of the sender's clock.
constexpr double kJitter_s = 0.006;
// So many may have been lost before those that were held up.
constexpr double kLostBeforeHoldUp = 2.0;
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
// Those that come so shortly after each other, in intervals, were held up.
constexpr double kAtOnce = 0.1;
// Share of the difference by which a sender that has become faster is followed with each sample.
constexpr double kFaster = 0.15;
// A sample that lies by so much of the way to the next off the motion to that, and not an interval before, came late.
constexpr double kClearOfWay = 0.2;
// Rhythm and sending are told apart by some sixty samples, so many more for one than for the other, and by none that is nearer than this to the
// motion on both.
constexpr double kWeighed = 64.0;
constexpr double kClearRhythm = 6.0;
constexpr double kSameTimes_rad = 2e-5;

/// Periods by which one that comes earlier is not the next.
double out_of_turn(double interval, double period_s) noexcept {
  return std::max(kOutOfTurn * interval, kJitter_s / period_s);
}

}  // namespace

// Whether the rhythm says that a sample, `gap` periods after it, was for later than it came.
bool StreamTarget::runs_ahead(double gap) const noexcept {
  return counted_lost_ == 0 && gap < -std::max(interval_, out_of_turn(interval_, period_s_));
}

// Samples that were lost on the way leave whole intervals out; those that were held up do not. Where a sample lies tells which it is: it
// is the one that its motion brings nearest. Where that does not tell, they are lost until they come after all.
double StreamTarget::intervals_in(double gap, const StreamSample& sample) noexcept {
  // Of those that nothing was counted lost before none can be for later than it comes.
  if (counted_lost_ > 0 ? gap < interval_ - out_of_turn(interval_, period_s_) : runs_ahead(gap)) {
    // The same again is a double.
    if (past_count_ > 0 && sample.position_rad == past_[0].position_rad) return 0.0;
    counted_lost_ = std::max(counted_lost_ - 1, 0);
    make_room();
    return 0.0;
  }
  // Of a faster stream it would be jitter that tells.
  if (counted_lost_ > 0 && gap < 1.5 * interval_ && seconds(interval_) > kJitter_s) reconsider(sample);
  const double most = std::max(1.0, std::round(gap / interval_));
  const double farthest = std::round((gap + 0.5 * kJitter_s / period_s_) / interval_);
  const bool short_gap = seconds(gap - (1.0 + kLostBeforeHoldUp) * interval_) <= kLongestHoldUp_s;
  const bool told = short_gap && farthest > 1.0 && past_count_ >= 2 && past_[0].velocity_rad_s != 0.0 &&
                    seconds(held_up_ * interval_) <= kLongestInARow_s;
  const double intervals = told ? nearest_of(most, farthest, sample) : most;
  held_up_ = intervals < most ? held_up_ + 1 : 0;
  counted_lost_ = static_cast<int>(std::min(intervals, static_cast<double>(kPast))) - 1;
  return intervals;
}

// What was taken for the sample of now was held up, and those before it, too, that came with it: it is this one.
void StreamTarget::make_room() noexcept {
  double free_from = arrival_;
  for (std::size_t i = 0; i < past_count_ && past_[i].at > free_from - 0.5 * interval_; ++i) {
    past_[i].at -= interval_;
    past_[i].clocked -= interval_;
    free_from = past_[i].at;
  }
}

// Whether the last sample, before which some were counted for lost, lies on the motion to this one an interval before: then it came late, and the
// one after it was lost.
void StreamTarget::reconsider(const StreamSample& sample) noexcept {
  if (past_count_ < 3) return;
  const Knot &a = past_[0], &b = past_[1], &c = past_[2];
  double Knot::*const time = a.told ? &Knot::clocked : &Knot::at;
  const double newest = arrival_ + interval_;
  if (a.*time - b.*time < 1.5 * interval_ || b.*time <= c.*time || a.*time >= newest) return;
  const double to_b = (sample.position_rad - b.position_rad) / (newest - b.*time);
  const double to_c = (b.position_rad - c.position_rad) / (b.*time - c.*time);
  const double bend = (to_b - to_c) / (newest - c.*time);
  const auto off_rad = [&](double at) {
    return std::abs(a.position_rad - b.position_rad - (at - b.*time) * (to_b + (at - newest) * bend));
  };
  const double here_rad = off_rad(a.*time);
  if (here_rad > kClearOfWay * std::abs(sample.position_rad - a.position_rad) &&
      off_rad(a.*time - interval_) < kClear * here_rad) {
    --counted_lost_;
    make_room();
  }
}

// The last sample with the motion that positions have in the rhythm.
StreamTarget::Knot StreamTarget::last_in_rhythm() const noexcept {
  Knot last = past_[0];
  const Knot &b = past_[1], &c = past_[2];
  if (!last.told || in_rhythm_ || past_count_ < 3 || last.clocked <= b.clocked || b.clocked <= c.clocked)
    return last;
  const double newer_s = seconds(last.clocked - b.clocked), older_s = seconds(b.clocked - c.clocked);
  const double newer_rad_s = (last.position_rad - b.position_rad) / newer_s;
  const double older_rad_s = (b.position_rad - c.position_rad) / older_s;
  last.acceleration_rad_s2 = 2.0 * (newer_rad_s - older_rad_s) / (newer_s + older_s);
  if (!last.moving) last.velocity_rad_s = newer_rad_s + 0.5 * newer_s * last.acceleration_rad_s2;
  last.jerk_rad_s3 = 0.0;
  return last;
}

// How many intervals, up to the `farthest`, the motion needs to get there; `most` if that is not clear.
double StreamTarget::nearest_of(double most, double farthest, const StreamSample& sample) const noexcept {
  const Knot last = last_in_rhythm();
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

// Where it is told when a sample was sent, this is what it is for, unless samples lie in the rhythm that their sender meant to keep. Of a stream that
// does not tell it of all, or by a clock that stands, of none.
void StreamTarget::time(const StreamSample& sample, Knot& knot) noexcept {
  untold_ = untold_ || sample.sent_us == 0 || sender_.repeats(sample.sent_us);
  knot.told = !untold_;
  if (!knot.told) {
    sender_.forget();
    clock_in(sample, present());
    knot.at = knot.clocked = arrival_;
    if (slow())
      for (std::size_t i = 0; i < past_count_; ++i)
        if (past_[i].clocked > 0.0) past_[i].at = on_grid(past_[i]);
    return;
  }
  sender_.take(sample.sent_us, present());
  knot.sent = sender_.sent();
  clock_in(sample, knot.sent + sender_.offset());
  knot.clocked = arrival_;
  weigh_rhythm(knot);
  // Nobody sends a sample before its time.
  if (in_rhythm_ && knot.clocked - knot.sent - sender_.offset() > out_of_turn(interval_, period_s_)) {
    in_rhythm_ = false;
    out_of_rhythm_ = 0.0;
  }
  const auto at = [&](const Knot& one) { return in_rhythm_ ? on_grid(one) : one.sent + sender_.offset(); };
  knot.at = at(knot);
  for (std::size_t i = 0; i < past_count_; ++i)
    if (past_[i].told) past_[i].at = at(past_[i]);
}

// Where the samples before it lie on the grid of the rhythm, which the smoothed instants of their arrivals approach.
double StreamTarget::on_grid(const Knot& one) const noexcept {
  return arrival_ - interval_ * std::round((arrival_ - one.clocked) / interval_);
}

// By how much it misses the polynomial through the samples before it that misses it least, of those through three and, in slow streams, more; by
// these times of theirs.
template <typename Time>
double StreamTarget::off_rad(const Knot& knot, const Time& time_of) const noexcept {
  std::array<double, kNodes + 1> differences{}, at{};
  const std::size_t most = std::min(slow() ? kNodes : 3, past_count_);
  double product = 1.0;
  double least_rad = std::numeric_limits<double>::infinity();
  at[0] = time_of(knot);
  differences[0] = knot.position_rad;
  for (std::size_t n = 1; n <= most && past_[n - 1].told; ++n) {
    at[n] = time_of(past_[n - 1]);
    if (at[n] >= at[n - 1]) break;
    differences[n] = past_[n - 1].position_rad;
    for (std::size_t i = n; i-- > 0;)
      differences[i] = (differences[i + 1] - differences[i]) / (at[n] - at[i]);
    product *= at[0] - at[n];
    if (n >= 3) least_rad = std::min(least_rad, std::abs(differences[0]) * product);
  }
  return least_rad;
}

// Where samples lie farther from a motion: in the rhythm, or where they were sent. What the parabola misses of the motion, it does on both.
void StreamTarget::weigh_rhythm(const Knot& knot) noexcept {
  if (past_count_ < 3 || !past_[0].told || !past_[1].told || !past_[2].told) return;
  const double sent_rad = off_rad(knot, [](const Knot& one) { return one.sent; });
  const double rhythm_rad = off_rad(knot, [this](const Knot& one) { return on_grid(one); });
  if (std::max(rhythm_rad, sent_rad) < kSameTimes_rad) return;
  const double sum = rhythm_rad * rhythm_rad + sent_rad * sent_rad;
  const double more = std::isfinite(sum) ? (rhythm_rad * rhythm_rad - sent_rad * sent_rad) / sum : 0.0;
  out_of_rhythm_ += more - out_of_rhythm_ / kWeighed;
  if (std::abs(out_of_rhythm_) > kClearRhythm) in_rhythm_ = out_of_rhythm_ < 0.0;
}

void StreamTarget::clock_in(const StreamSample& sample, double came) noexcept {
  ++arrivals_;
  const double gap = came - arrival_;
  const double since_last = came - came_;
  const bool at_once = arrivals_ > 1 && since_last < 0.5;
  came_ = came;
  if (arrivals_ == 1) first_came_ = came_;
  // Among as many from the first on as one hold-up may hold, one a period, one that comes with the one before was held up: no interval is
  // known yet that could tell. Later, it may be one that was taken for lost.
  const bool among_first = arrivals_ <= kLocked || (arrivals_ <= kLongestHoldUp_s / period_s_ &&
                                                    seconds(came_ - first_came_) <= kLongestInARow_s);
  if (at_once && among_first && gap < kOutOfTurn * interval_) return clock_in_held_up();
  if (arrivals_ <= 2) {
    interval_ = arrivals_ == 2 ? std::max(gap, 1.0) : 0.0;
    arrival_ = came;
    counted_lost_ = 0;
    held_up_ = 0;
    return;
  }
  if (usual_gap_.take(since_last, interval_, kJitter_s / period_s_)) {
    interval_ = std::max(1.0, usual_gap_.interval());
    arrival_ = came - usual_gap_.late();
    arrivals_ = usual_gap_.told_by() + 1;
    counted_lost_ = held_up_ = 0;
    return;
  }
  // The rhythm is ahead of the samples by more than an interval, while they come one after the other and not, as after a hold-up, at once.
  if (runs_ahead(gap) && since_last > std::max(1.5, kAtOnce * interval_))
    interval_ += kFaster * std::min(0.0, since_last - interval_);
  const double n = arrivals_;
  const double intervals = intervals_in(gap, sample);
  if (intervals == 0.0) return;
  // What was held up says nothing of the sender's clock.
  const double off = gap - intervals * interval_;
  const bool later = n > kLocked && seconds(off) > kJitter_s;
  const bool alone = later && !std::exchange(later_, later);
  if (!later) later_ = false;
  const double late =
      alone || (held_up_ > 0 && seconds(off) > kJitter_s) ? 0.0 : std::min(off, 0.5 * interval_);
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

}  // namespace strainwave
