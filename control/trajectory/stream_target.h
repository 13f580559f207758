// A stream of setpoints as a motion: where the joint is to be in each period, between the samples and a little
// beyond the last. Real-time safe; time is counted in periods, a sample's own time included. Joint side, SI.
//
//   knot (t, p, v, a)   every sample becomes one: the motion leads from where it is now to it by a quintic
//                       (Hermite), so that position, velocity and acceleration have no step, whatever arrives
//   time of a knot      its own, if the sample has one; else when it was sent, if that is told (control/trajectory/sender_clock.h), or the
//                       rhythm of that, on whichever samples lie closer to a motion; else the smoothed instant of its arrival (a phase-locked
//                       loop over the arrivals). Who follows is later than the target by a known time, by which the target
//                       is ahead of the samples. A knot for which too little time is left is carried forward to one interval
//                       from now, 20 ms at least, so that what a network does to arrivals makes no jerks
//   velocity            the sample's own, and the motion has no lag; else from three positions 10 ms (not stamped: 20 ms) apart, or
//                       consecutive ones where they lie farther apart:
//                         d01 + (t0 - t1) (d01 - d12) / (t0 - t2),  dij = (pi - pj) / (ti - tj)
//                       and the motion lags one interval. Accelerations that are not given by velocities, likewise. Below 48 Hz by the
//                       polynomial through up to five samples, of which each more says no more that is new than half of what one of
//                       the two before it did, and has helped of late (control/trajectory/node_weights.h): what a sample's time is off would grow twentyfold where
//                       one is lost. Where more have not helped, by the least squares of fourteen if these have (control/trajectory/motion_fit.h)
//   contradiction       a velocity that is not that of the positions is not used, and none where most are not; the positions are. Where samples are
//                       stamped, each shows it. Likewise an acceleration farther than the limit from that of the velocities. What is carried
//                       forward is no farther from the line through the last two samples than that could take it: A t (t + T) / 2, T between them
//   withdrawn           of samples of their own times the newest order counts: it takes the place of all that are for later
//   load                along a straight line from knot to knot; without a sample's time it is there an interval after the sample. After
//                       the last it stays
//   arrival             a sample that comes late was held up, or those before it were lost. Its place on the motion tells which; where it does
//                       not, they were lost until they come after all. What was held up says nothing of the sender's clock
//   no new sample       the motion goes on as it was, with its acceleration and in slow streams its jerk, for `bridge_s`, two intervals at
//                       least, from half an interval after the next was due, 0.2 s at most, and then has
//                       ended: the joint is to come to rest. A target that stands still stays where it is
//   missed              a motion that was carried on, or has ended, and goes on, is caught up with in the time since its last sample, 0.2 s at
//                       most: until then every knot is carried forward to the end of that time
//   confined            who follows at speed v and could not come to rest before it is farther out than the last samples and what
//                       their speed V takes since the last of them is led to rest there until it could and the target is back:
//                         V (now - t) + V max(T / 2, 10 ms) + max(V^2, w (2 v - w)) / 2A,  w the target's speed
//                       where the motion was carried on and has not caught up yet, V is no less than what it was carried on with, and `now` the
//                       end of catching up. What is always late, near the limits, would else be driven farther with each swing
//   out of reach        a knot that needs more than twice the limit of speed, or positions that need more than twice
//                       that of acceleration, are a new place, not a motion: the target is there, at rest, and
//                       whoever follows goes there as fast as the joint may
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "control/trajectory/motion_fit.h"
#include "control/trajectory/node_weights.h"
#include "control/trajectory/sender_clock.h"
#include "control/trajectory/stream_sample.h"
#include "control/trajectory/usual_gap.h"

namespace strainwave {

class StreamTarget {
 public:
  /// `period_s` > 0; `bridge_s` >= 0.
  StreamTarget(double period_s, double bridge_s) noexcept
      : period_s_(period_s), bridge_s_(bridge_s), sender_(period_s) {}

  /// What who follows can do; a motion that needs much more is none. All > 0.
  struct Reach {
    double velocity_rad_s = 1.0;
    double acceleration_rad_s2 = 1.0;
  };

  /// A stream begins where the joint is to be now, with this load; from now on the target is ahead of its samples' times by
  /// `lead_periods` >= 0.
  void begin(double position_rad, double velocity_rad_s, double lead_periods,
             const ToldLoad& load = {}) noexcept;
  double lead_periods() const noexcept { return lead_; }  ///< as begin() was told
  /// The stream that has ended goes on with the next sample: who followed it is here by now, with this load.
  void resume(double position_rad, double velocity_rad_s, const ToldLoad& load) noexcept;
  /// So many periods went by since it ended.
  void wait(std::int64_t periods) noexcept {
    now_ += static_cast<double>(periods);
    left_out_ = 0.0;
  }
  /// What comes now comes so many periods, >= 0, after the one that the next step() begins: those that the loop left out, through which
  /// step() will go one by one.
  void leave_out(std::int64_t periods) noexcept { left_out_ = static_cast<double>(periods); }
  /// So many periods went by in which nobody followed: the target has gone on, as far as it goes without new samples.
  void skip(std::int64_t periods) noexcept;
  void take(const StreamSample& sample, const Reach& reach) noexcept;
  /// The target of the period that begins now; time goes on by one period.
  MovingTarget step() noexcept;
  /// From where the target is now to where the samples take it, as far as they are known: with a velocity for some time beyond the last.
  double way_ahead_rad() const noexcept;
  /// Which way a follower of the target is confined: 1 up, -1 down, 0 not.
  using Confinement = int;
  /// `target`, the one of this period, for a follower that is at this place with this velocity.
  MovingTarget confined(const MovingTarget& target, double position_rad, double velocity_rad_s,
                        Confinement& way) const noexcept;
  /// The samples have stopped coming while the target moved. Until the next begin() or resume().
  bool ended() const noexcept { return ended_; }

 private:
  static constexpr std::size_t kKnots = 1024;  ///< that may lie in the future: a second of 1 kHz
  static constexpr std::size_t kPast = 24;     ///< samples that velocities are estimated from
  /// Multiple of a limit that a motion may need: one that needs more is a new place.
  static constexpr double kReach = 2.0;
  /// From so slow a stream on more than three samples tell velocity, acceleration and jerk: in faster ones it would be their noise.
  static constexpr double kSlow_s = 0.021;
  static constexpr std::size_t kNodes = NodeWeights::kMost;  ///< samples that they tell them from at most
  /// Velocities are estimated from positions that are at least so far apart.
  static constexpr double kApart_s = 0.01;
  struct Knot {
    double at = 0.0;  ///< period
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
    double acceleration_rad_s2 = 0.0;
    double jerk_rad_s3 = 0.0;  ///< as three samples show it, or up to five of a slow stream
    ToldLoad load{};
    double sent_ahead = 0.0;  ///< periods from when it came until `at`, and the lead
    double sent_rad_s = 0.0;  ///< the velocity that came with it, believed or not
    bool moving = false;      ///< one came with it, and is believed
    bool carried = false;     ///< forward: not what was sent
    bool smooth = false;   ///< three samples show its acceleration, which changes little from one to the next
    bool stamped = false;  ///< came with a time of its own
    bool told = false;     ///< when it was sent: `at` is `clocked`, or `sent` and the way
    double sent = 0.0;     ///< SenderClock::sent()
    double clocked = 0.0;  ///< period: by the loop that is locked to the sender's rhythm
    double due = 0.0;  ///< period: from then on the next sample is missed; before `at` only while catching up
    bool rests() const noexcept { return velocity_rad_s == 0.0 && acceleration_rad_s2 == 0.0; }
  };
  /// Where some samples are.
  struct Hull {
    double low_rad = std::numeric_limits<double>::infinity();
    double high_rad = -std::numeric_limits<double>::infinity();
    double fastest_rad_s = 0.0;  ///< >= 0
    void widen(const Knot& knot) noexcept {
      low_rad = std::min(low_rad, knot.position_rad);
      high_rad = std::max(high_rad, knot.position_rad);
      fastest_rad_s = std::max(fastest_rad_s, std::abs(knot.velocity_rad_s));
    }
    void widen(const Hull& hull) noexcept {
      low_rad = std::min(low_rad, hull.low_rad);
      high_rad = std::max(high_rad, hull.high_rad);
      fastest_rad_s = std::max(fastest_rad_s, hull.fastest_rad_s);
    }
  };
  /// First in, first out; what is too much takes the place of the last.
  class Queue {
   public:
    bool empty() const noexcept { return count_ == 0; }
    void clear() noexcept {
      count_ = 0;
      begin_hull();
      older_ = {};
    }
    /// Of all that wait, and of as many before them at most.
    Hull hull() const noexcept {
      Hull all = older_;
      all.widen(newer_);
      return all;
    }
    const Knot& operator[](std::size_t i) const noexcept { return knots_[(first_ + i) % kKnots]; }
    const Knot& last() const noexcept { return (*this)[count_ - 1]; }
    std::size_t size() const noexcept { return count_; }
    void push(const Knot& knot) noexcept {
      count_ = std::min(count_ + 1, kKnots);
      replace_last(knot);
    }
    void replace_last(const Knot& knot) noexcept {
      knots_[(first_ + count_ - 1) % kKnots] = knot;
      newer_.widen(knot);
    }
    /// All that lie at this period or later.
    void drop_from(double period) noexcept {
      while (count_ > 0 && last().at >= period) --count_;
      newer_ = older_ = {};
      older_left_ = 0;
      for (std::size_t i = 0; i < count_; ++i) newer_.widen((*this)[i]);
    }
    Knot pop() noexcept {
      const Knot& first = (*this)[0];
      first_ = (first_ + 1) % kKnots;
      --count_;
      if (older_left_ == 0 || --older_left_ == 0) begin_hull();
      return first;
    }

   private:
    /// All that wait are of the newer one, and the older one's are gone.
    void begin_hull() noexcept {
      older_ = std::exchange(newer_, Hull{});
      older_left_ = count_;
    }
    std::array<Knot, kKnots> knots_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    Hull older_;
    Hull newer_;
    std::size_t older_left_ = 0;  ///< of its knots, still waiting
  };
  struct State {
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
    double acceleration_rad_s2 = 0.0;
  };
  /// The samples that a new one's motion is judged by; null: there is none.
  struct Before {
    const Knot* last = nullptr;
    const Knot* first = nullptr;  ///< before `last`
  };
  /// By time.
  struct Derivatives {
    double first = 0.0;
    double second = 0.0;
    double third = 0.0;
  };
  Derivatives derivatives_at(const Knot& newest, const Before& before, double Knot::*value) noexcept;
  ToldLoad load_at(double period) const noexcept;
  double seconds(double periods) const noexcept { return periods * period_s_; }
  double expected_interval() const noexcept;
  bool slow() const noexcept { return seconds(expected_interval()) > kSlow_s; }
  bool believes(const Knot& knot, const Before& before) noexcept;
  void time(const StreamSample& sample, Knot& knot) noexcept;
  bool runs_ahead(double gap) const noexcept;
  void make_room() noexcept;
  void reconsider(const StreamSample& sample) noexcept;
  Knot last_in_rhythm() const noexcept;
  void weigh_rhythm(const Knot& knot) noexcept;
  double on_grid(const Knot& one) const noexcept;
  template <typename Time>
  double off_rad(const Knot& knot, const Time& time_of) const noexcept;
  void clock_in(const StreamSample& sample, double came) noexcept;
  void clock_in_held_up() noexcept;
  double intervals_in(double gap, const StreamSample& sample) noexcept;
  double nearest_of(double most, double farthest, const StreamSample& sample) const noexcept;
  void withdraw_from(double period) noexcept;
  void remember(const Knot& knot) noexcept;
  const Knot* sample_before(double period, double apart_s) const noexcept;
  void estimate_derivatives(const StreamSample& sample, const Before& before, Knot& knot) noexcept;
  Knot carried_forward(const StreamSample& sample, const Knot& knot, double least_ahead,
                       double lag) const noexcept;
  double least_ahead() const noexcept;
  void catch_up_in(double periods) noexcept;
  void queue(const StreamSample& sample, const Knot& knot) noexcept;
  double begins() const noexcept { return now_ + left_out_; }  // the period in which samples come
  double present() const noexcept { return begins() - lead_; }
  void derive_from_positions(const Before& before, Knot& knot) noexcept;
  bool fits_better(const Knot& newest, const Before& before, double missed_rad) noexcept;
  void lead_to(const Knot& knot) noexcept;
  bool rests_at(const Knot& knot) const noexcept;
  bool crowds(const Knot& knot) const noexcept;
  bool hurries() const noexcept;
  bool alone() const noexcept { return past_count_ == 1; }  // one sample has no speed
  void lead_load_to(const Knot& knot) noexcept;
  State at(double period) noexcept;
  State between(double period) const noexcept;
  State beyond(double period) const noexcept;
  double longest_bridge_s() const noexcept;
  double carried_on_jerk_rad_s3(const Knot& knot) const noexcept;
  Hull known() const noexcept;

  double period_s_;
  double bridge_s_;
  double lead_ = 0.0;      ///< periods
  double now_ = 0.0;       ///< periods since begin(), and the lead
  double left_out_ = 0.0;  ///< periods after now_ that have gone by
  State state_;            ///< now
  ToldLoad load_;          ///< now
  ToldLoad load_from_;
  ToldLoad load_to_;
  double load_from_at_ = 0.0;  ///< periods, as now_; so the next
  double load_to_at_ = 0.0;
  Knot from_;  ///< the quintic's begin ...
  Knot to_;    ///< ... and end
  Reach reach_;
  Queue waiting_;              ///< knots after to_, by time
  double mean_rad_s_ = 0.0;    ///< from the last sample but one to the last
  double mean_s_ = 0.0;        ///< the time between them; 0: there is but one
  double interval_ = 0.0;      ///< between samples, in periods, smoothed; 0: only one has come
  double arrival_ = 0.0;       ///< of the last sample, smoothed
  double came_ = 0.0;          ///< when it came
  double first_came_ = 0.0;    ///< when the first of arrivals_ did
  double caught_up_at_ = 0.0;  ///< period: until then what was missed is caught up with
  UsualGap usual_gap_;
  int counted_lost_ = 0;  ///< intervals before the last sample
  bool later_ = false;    ///< the last sample was, than jitter makes it
  int held_up_ = 0;       ///< samples in a row
  SenderClock sender_;
  bool untold_ = false;         ///< of a sample of this stream nobody said when it was sent
  double out_of_rhythm_ = 0.0;  ///< samples that lie off it, more than off where they were sent
  bool in_rhythm_ = false;      ///< samples are for the instants of the rhythm, not for when they were sent
  NodeWeights nodes_;
  MotionFit fit_;
  int doubted_ = 0;   ///< its velocities: more with each that contradicts, less with each that agrees
  int arrivals_ = 0;  ///< untimed ones, that the loop has locked to
  std::array<Knot, kPast> past_{};  ///< the last samples as they were, newest first
  std::size_t past_count_ = 0;
  std::size_t left_behind_ = 0;  ///< of past_, after those: too long before them to tell of their motion
  Hull hull_;                    ///< of past_
  bool missed_ = false;          ///< the motion was carried on, or ended, and not by what was known of it
  bool ended_ = false;
};

}  // namespace strainwave
