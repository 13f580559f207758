// SPDX-License-Identifier: BSD-3-Clause
// A stream of setpoints: where a joint shall be at which time. docs/streams.md. Not real-time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <strainwave/setpoint_v1.hpp>

namespace strainwave {

class JointLink;
class Stream;

struct StreamOptions {
  /// How long before its time a sample is sent: what the network and this program may be late by. Above 0 to 0.9.
  double ahead_s = 0.1;
  /// The stream ends when no sample comes for so long; the joint comes to rest before that. Above 0 to 10.
  double valid_for_s = 2.0;
  double speed_limit_rad_s = 0.0;  ///< 0: as fast as the joint may
  /// A stream that begins far from the joint is approached at the speed of a move; else the daemon refuses it.
  bool approach = false;
  /// The stream of another joint of this daemon: the same time is the same cycle then.
  const Stream* beside = nullptr;
};

/// What the daemon does not know of what a joint does and carries at a sample.
struct CarriedLoad {
  double torque_Nm = 0.0;          ///< added to what the daemon plans: gravity, contact; joint side
  double load_inertia_kgm2 = 0.0;  ///< >= 0, carried besides the joint's own
};

/// Made by Joint::stream(). Its destructor closes it; after an exception the joint is ordered to hold at once.
class Stream {
 public:
  ~Stream();
  Stream(Stream&&) noexcept;
  Stream& operator=(Stream&&) = delete;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// The joint shall be at `position_rad` at time `t_s` (rising by 0.5 s at most; the first is `ahead_s` from now), with the velocity and
  /// acceleration then if they are known. Waits until the sample is due to be sent, `ahead_s` before its time, so that a loop over t
  /// runs at the joint's pace. False: it came after its time and was left out. Throws Refused, Faulted, Yielded, NotDone (also when the
  /// stream is over), NoAnswer, InvalidInput.
  bool put(double t_s, double position_rad, std::optional<double> velocity_rad_s = {},
           std::optional<double> acceleration_rad_s2 = {}, const CarriedLoad& load = {});

  /// Waits for the last sample's time, ends the stream and waits until the joint holds. Where that fails, the joint is ordered to
  /// hold first, and then the error is thrown. The destructor does the same, once, but reports nothing.
  void close();

  /// The daemon's cycle that the sample of time `t_s` is for, as `cycle` of the states counts: what was ordered can be compared with what the
  /// joint did. Throws NotDone before the first put(), which sets the time, and InvalidInput for a `t_s` beyond -1e12 to 1e12.
  std::int64_t cycle_of(double t_s) const;

  /// Samples that came after their time: left out, or refused by the daemon (34).
  long late() const noexcept { return late_; }
  /// Samples that the daemon refused since they quoted an old state (30): the program takes states too late.
  long outdated() const noexcept { return outdated_; }

 private:
  friend class Joint;
  struct TimeBase;
  Stream(std::shared_ptr<JointLink> link, const StreamOptions& options);
  static std::shared_ptr<TimeBase> base_of(JointLink& link, const Stream* beside);

  setpoint_v1 sample(double position_rad, std::optional<double> velocity_rad_s,
                     std::optional<double> acceleration_rad_s2, const CarriedLoad& load) const;
  void begin(double t_s, setpoint_v1 message);
  void wait_until_due(std::int64_t cycle);
  void check_refusals();
  void check_joint();
  void check_state(std::int64_t from_cycle);
  void lose();
  bool restarted() const;
  void check_restart();
  void wait_for_end();
  void hold();
  void leave_out(std::int64_t cycle);
  void end() noexcept;

  std::shared_ptr<JointLink> link_;
  std::shared_ptr<TimeBase> base_;
  StreamOptions options_;
  double period_s_;
  std::int64_t stream_id_;
  std::optional<double> last_t_s_;
  std::optional<std::int64_t> last_cycle_;  ///< of the last sample that was sent; nothing: not begun, or over
  std::int64_t first_cycle_ = 0;            ///< of the sample that it began with
  std::int64_t session_id_ = 0;             ///< of the daemon that it began with
  bool over_ = false;                       ///< closed, or ended by another order
  long late_ = 0;
  long outdated_ = 0;
  int exceptions_;  ///< under way when it was made
};

}  // namespace strainwave
