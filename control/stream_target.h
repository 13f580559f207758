// A stream of setpoints as a motion: where the joint is to be in each period, between the samples and a little
// beyond the last. Real-time safe; time is counted in periods, a sample's own time included. Joint side, SI.
//
//   knot (t, p, v, a)   every sample becomes one: the motion leads from where it is now to it by a quintic
//                       (Hermite), so that position, velocity and acceleration have no step, whatever arrives
//   time of a knot      its own, if the sample has one; else the smoothed instant of its arrival (a phase-locked
//                       loop over the arrivals), carried forward by one interval, 20 ms at least, so that what a
//                       network does to arrivals makes no jerks
//   velocity            the sample's own, and the motion has no lag; else from three positions 10 ms apart, or
//                       consecutive ones where they lie farther apart:
//                         d01 + (t0 - t1) (d01 - d12) / (t0 - t2),  dij = (pi - pj) / (ti - tj)
//                       and the motion lags one interval. Accelerations that are not given by velocities, likewise
//   contradiction       a velocity that is not that of the positions is not used; the positions are
//   no new sample       the motion goes on as it was for three intervals, 0.2 s at most, and then has ended: the
//                       joint is to come to rest. A target that stands still stays where it is
//   out of reach        a knot that needs more than twice the limit of speed, or positions that need more than twice
//                       that of acceleration, are a new place, not a motion: the target is there, at rest, and
//                       whoever follows goes there as fast as the joint may
#pragma once

#include <array>
#include <cstdint>

namespace strainwave {

/// One setpoint of a stream. All finite.
struct StreamSample {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;       ///< with derivatives >= 1
  double acceleration_rad_s2 = 0.0;  ///< with derivatives == 2
  int derivatives = 0;               ///< how many of the position's are given: 0, 1 or 2
  /// Periods from now to the instant that it is for, > 0; 0: none is given.
  std::int64_t in_periods = 0;
};

/// Target of a period: at its begin and at its end.
struct MovingTarget {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double next_position_rad = 0.0;
  double next_velocity_rad_s = 0.0;
  bool rests() const noexcept { return velocity_rad_s == 0.0 && next_velocity_rad_s == 0.0; }
};

class StreamTarget {
 public:
  /// `period_s` > 0.
  explicit StreamTarget(double period_s) noexcept : period_s_(period_s) {}

  /// What who follows can do; a motion that needs much more is none. All > 0.
  struct Reach {
    double velocity_rad_s = 1.0;
    double acceleration_rad_s2 = 1.0;
  };

  /// A stream begins where the joint is to be now.
  void begin(double position_rad, double velocity_rad_s) noexcept;
  void take(const StreamSample& sample, const Reach& reach) noexcept;
  /// The target of the period that begins now; time goes on by one period.
  MovingTarget step() noexcept;
  /// The samples have stopped coming while the target moved. Until the next begin().
  bool ended() const noexcept { return ended_; }

 private:
  static constexpr std::size_t kKnots = 32;  ///< that may lie in the future
  static constexpr std::size_t kPast = 24;   ///< samples that velocities are estimated from
  struct Knot {
    double at = 0.0;  ///< period
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
    double acceleration_rad_s2 = 0.0;
    double jerk_rad_s3 = 0.0;  ///< as three samples show it
    double sent_rad_s = 0.0;   ///< the velocity that came with it, believed or not
  };
  struct State {
    double position_rad = 0.0;
    double velocity_rad_s = 0.0;
    double acceleration_rad_s2 = 0.0;
  };
  double seconds(double periods) const noexcept { return periods * period_s_; }
  bool contradicts_itself(const Knot& knot) const noexcept;
  void clock_in() noexcept;
  void remember(const Knot& knot) noexcept;
  const Knot* before(double period) const noexcept;
  void estimate_derivatives(const StreamSample& sample, Knot& knot) noexcept;
  Knot carried_forward(const StreamSample& sample, const Knot& knot, double since_last) const noexcept;
  void queue(const Knot& knot) noexcept;
  void derive_from_positions(const Knot& last, const Knot* first, Knot& knot) noexcept;
  void lead_to(const Knot& knot) noexcept;
  State at(double period) noexcept;
  State between(double period) const noexcept;
  State beyond(double period) noexcept;

  double period_s_;
  double now_ = 0.0;  ///< periods since begin()
  State state_;       ///< now
  Knot from_;         ///< the quintic's begin ...
  Knot to_;           ///< ... and end
  Reach reach_;
  std::array<Knot, kKnots> waiting_{};  ///< knots after to_, by time
  std::size_t waiting_count_ = 0;
  double interval_ = 0.0;           ///< between samples, in periods, smoothed; 0: only one has come
  double arrival_ = 0.0;            ///< of the last sample, smoothed
  int arrivals_ = 0;                ///< untimed ones, that the loop has locked to
  std::array<Knot, kPast> past_{};  ///< the last samples as they were, newest first
  std::size_t past_count_ = 0;
  bool ended_ = false;
};

}  // namespace strainwave
