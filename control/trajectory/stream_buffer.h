// SPDX-License-Identifier: BSD-3-Clause
// A stream of setpoints as a motion: where the joint is to be in each period. Samples wait, sorted by the instant that they are for, and are
// played out. Real-time safe; time is counted in periods. Joint side, SI.
//
//   instant       the cycle that a sample is for; or when it was sent, on our clock (control/trajectory/sender_clock.h), and the play-out
//                 delay, which covers what the network's jitter and the sender's interval take
//   motion        from where the target is now to the first sample that is 20 ms ahead, by a quintic (Hermite): position, velocity and
//                 acceleration have no step, whatever arrives. Planned anew with every sample
//   derivatives   not sent: of the polynomial through the sample that fits its neighbours best, before and after it
//   no sample     the motion goes on with its acceleration for some intervals, then with its velocity, `bridge_s` or two
//                 intervals, whichever is longer, and half an interval; 0.2 s at most. Then the stream has ended: the joint is to come to
//                 rest. A target that stands still stays where it is
//   a gap         is caught up with in the time that was missed, 0.2 s at most
//   new place     a sample that needs twice the joint's speed or acceleration is no part of a motion: the target is there, at rest
//   contradiction a velocity that is not that of the positions is not used; where it goes on, the stream is to end
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "control/joint/motion_limits.h"
#include "control/trajectory/moving_mean.h"
#include "control/trajectory/sender_clock.h"
#include "control/trajectory/stream_sample.h"

namespace strainwave {

class LocalPolynomial;

/// `period_s` > 0, `count_rad` > 0, the rest >= 0.
struct StreamConfig {
  double period_s = 0.001;
  double bridge_s = 0.05;   ///< without samples
  double delay_s = 0.03;    ///< of samples that say when they were sent
  double count_rad = 1e-6;  ///< what an encoder cannot tell
};

class StreamBuffer {
 public:
  explicit StreamBuffer(const StreamConfig& config) noexcept : config_(config), sender_(config.period_s) {}

  /// A stream begins where the joint is to be now; from now on the target is ahead of its samples by `lead_periods` >= 0.
  void begin(double position_rad, double velocity_rad_s, double lead_periods,
             const StreamLoad& load) noexcept;
  /// The stream that has ended goes on with the next sample, from here.
  void resume(double position_rad, double velocity_rad_s, const StreamLoad& load) noexcept;
  double lead_periods() const noexcept { return lead_; }
  /// After a wait through which the joint was not led: the target is where the motion that it was led on is now.
  void catch_up() noexcept {
    if (count_ > 0) move_to(play());
  }
  /// Periods go by in which no step() is taken.
  void wait(std::int64_t periods) noexcept {
    now_ += static_cast<double>(periods);
    left_out_ = 0.0;
  }
  /// Samples that come now come so many periods after the one that the next step() begins: the loop left them out.
  void leave_out(std::int64_t periods) noexcept { left_out_ = static_cast<double>(periods); }
  /// `reach`: what the joint can do.
  SampleFate take(const StreamSample& sample, const MotionLimits& reach) noexcept;
  /// The target of the period that begins now; time goes on by one period.
  MovingTarget step() noexcept;
  /// No sample came while the target moved. Until begin() or resume().
  bool ended() const noexcept { return ended_; }
  /// Velocity of the last two samples over the rate of their positions: 1 where they agree; 0 where the positions stand.
  double velocity_ratio() const noexcept;

 private:
  static constexpr std::size_t kSamples = 1024;  ///< that may wait: a second of 1 kHz

  struct Way {
    double shown_rad = 0.0;  ///< by the positions of two samples
    double told_rad = 0.0;   ///< by their velocities
  };
  struct Knot {
    double at = 0.0;  ///< periods
    MotionPoint state;
    StreamLoad load{};
    int derivatives = 2;
    bool new_place = false;    ///< samples before it are of another motion
    bool contradicts = false;  ///< its velocity is not that of the positions
    /// How many of its derivatives are used.
    std::size_t believed() const noexcept { return contradicts ? 0 : static_cast<std::size_t>(derivatives); }
    Way way_since(const Knot& before, double period_s) const noexcept;
    bool is_contradicted_by(const Knot& before, const StreamConfig& config) const noexcept;
  };

  const Knot& knot(std::size_t i) const noexcept { return knots_[(first_ + i) % kSamples]; }
  const Knot& last() const noexcept { return knot(count_ - 1); }
  void insert(Knot knot) noexcept;
  /// Now, in the time of the samples.
  double play() const noexcept { return now_ + lead_ - origin_; }
  double seconds(double periods) const noexcept { return periods * config_.period_s; }
  std::size_t first_from(double at) const noexcept;
  void lead_on() noexcept;
  bool stands(std::size_t i) const noexcept;
  void fit_neighbours(std::size_t i, LocalPolynomial& fit) const noexcept;
  Knot derived(std::size_t i) const noexcept;
  bool is_new_place(const Knot& knot) const noexcept;
  MotionPoint carried(double at) const noexcept;
  MotionPoint between(double at) const noexcept;
  StreamLoad load_at(double at) const noexcept;
  void move_to(double at) noexcept;

  StreamConfig config_;
  MotionLimits reach_;  ///< of the joint, its accelerations either way
  SenderClock sender_;
  std::array<Knot, kSamples> knots_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  double lead_ = 0.0;
  double now_ = 0.0;       ///< periods since construction
  double left_out_ = 0.0;  ///< periods after now_ that have gone by
  double origin_ = 0.0;    ///< of the samples' time, in now_'s
  double interval_ = 10.0;
  double caught_up_at_ = 0.0;      ///< in now_'s periods, after a gap
  Knot state_;                     ///< now
  Knot from_;                      ///< the quintic's begin ...
  Knot to_;                        ///< ... and end, on the motion of ...
  Knot anchor_;                    ///< ... this sample
  double contradicts_from_ = 0.0;  ///< instant of the first of them
  bool ended_ = false;
};

}  // namespace strainwave
