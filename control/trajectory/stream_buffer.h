// SPDX-License-Identifier: BSD-3-Clause
// Turns a stream of setpoints into a motion: the target of the joint in each period. Samples wait in the order of their instants and are
// played out. Real-time safe; time is counted in periods. Joint side, SI.
//
//   instant       the cycle that a sample is for; or its time of sending on our clock (control/trajectory/sender_clock.h) plus the play-out
//                 delay, which covers the network's jitter and the sender's interval
//   motion        a quintic Hermite segment from the present target to the first sample at least 20 ms ahead. Position, velocity and
//                 acceleration have no step, whatever arrives. Every sample replans it
//   derivatives   missing ones come from a polynomial through the sample, fitted to its neighbours before and after it
//   no sample     the motion continues with its acceleration for some intervals, then with its velocity. After `bridge_s` or two intervals,
//                 whichever is longer, and half an interval, at most 0.2 s, the stream has ended: the joint is to come to rest. A target
//                 at standstill stays where it is
//   a gap         is made up for within the time that was missed, at most 0.2 s
//   new place     a sample that needs twice the joint's speed or acceleration belongs to no motion: the target is there, at rest
//   contradiction a velocity that contradicts the positions is not used; if contradictions last, the stream is to end
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
  double bridge_s = 0.05;   ///< time without samples
  double delay_s = 0.03;    ///< play-out delay of samples with their time of sending
  double count_rad = 1e-6;  ///< resolution of the encoder
};

class StreamBuffer {
 public:
  explicit StreamBuffer(const StreamConfig& config) noexcept : config_(config), sender_(config.period_s) {}

  /// Begins a stream at the present target. From now on the target leads its samples by `lead_periods` >= 0.
  void begin(double position_rad, double velocity_rad_s, double lead_periods,
             const StreamLoad& load) noexcept;
  /// A stream that has ended continues from here with its next sample.
  void resume(double position_rad, double velocity_rad_s, const StreamLoad& load) noexcept;
  double lead_periods() const noexcept { return lead_; }
  /// After a wait in which the joint was not led: moves the target to the present point of its motion.
  void catch_up() noexcept {
    if (count_ > 0) move_to(play());
  }
  /// Lets periods pass without step().
  void wait(std::int64_t periods) noexcept {
    now_ += static_cast<double>(periods);
    left_out_ = 0.0;
  }
  /// Samples that arrive now arrive `periods` after the period of the next step(), since the loop skipped those.
  void leave_out(std::int64_t periods) noexcept { left_out_ = static_cast<double>(periods); }
  /// Takes a sample; `reach`: limits of the joint.
  SampleFate take(const StreamSample& sample, const MotionLimits& reach) noexcept;
  /// The target of the period that begins now; advances time by one period.
  MovingTarget step() noexcept;
  /// Whether samples stopped while the target moved. Until begin() or resume().
  bool ended() const noexcept { return ended_; }
  /// Velocity of the last two samples relative to the rate of their positions: 1 if they agree, 0 if the positions stand still.
  double velocity_ratio() const noexcept;

 private:
  static constexpr std::size_t kSamples = 1024;  ///< that may wait: a second at 1 kHz

  struct Way {
    double shown_rad = 0.0;  ///< by the positions of two samples
    double told_rad = 0.0;   ///< by their velocities
  };
  struct Knot {
    double at = 0.0;  ///< periods
    MotionPoint state;
    StreamLoad load{};
    int derivatives = 2;
    bool new_place = false;    ///< samples before it belong to another motion
    bool contradicts = false;  ///< its velocity contradicts the positions
    /// Number of its derivatives that are used.
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
  MotionLimits reach_;  ///< limits of the joint, with one acceleration for both ways
  SenderClock sender_;
  std::array<Knot, kSamples> knots_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  double lead_ = 0.0;
  double now_ = 0.0;       ///< periods since construction
  double left_out_ = 0.0;  ///< skipped periods after now_
  double origin_ = 0.0;    ///< of the samples' time, in now_'s time
  double interval_ = 10.0;
  double caught_up_at_ = 0.0;      ///< end of catching up after a gap, in now_'s time
  Knot state_;                     ///< now
  Knot from_;                      ///< the quintic's beginning ...
  Knot to_;                        ///< ... and end, on the motion of ...
  Knot anchor_;                    ///< ... this sample
  double contradicts_from_ = 0.0;  ///< instant of the first contradiction in a row
  bool ended_ = false;
};

}  // namespace strainwave
