// SPDX-License-Identifier: BSD-3-Clause
// A stream of setpoints: positions of a joint at given times. docs/streams.md. Not real-time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <strainwave/setpoint_v1.hpp>

namespace strainwave {

class JointLink;
class Stream;

struct StreamOptions {
  /// How long before its time a sample is sent. It covers the latency and jitter of network and program. Above 0, at most 0.9.
  double ahead_s = 0.1;
  /// The stream ends when no sample comes for this time; the joint comes to rest before that. Above 0, at most 10.
  double valid_for_s = 2.0;
  double speed_limit_rad_s = 0.0;  ///< 0: as fast as the joint may
  /// With true, the joint approaches a stream that begins far away, at the speed of a move. With false, the daemon refuses such a stream.
  bool approach = false;
  /// The stream of another joint of this daemon: equal times then mean equal cycles in both.
  const Stream* beside = nullptr;
};

/// Torque and inertia at a sample that the daemon cannot know.
struct CarriedLoad {
  double torque_Nm = 0.0;          ///< added to the planned torque: gravity, contact; joint side
  double load_inertia_kgm2 = 0.0;  ///< >= 0, added to the joint's own inertia
};

/// Joint::stream() makes it. The destructor closes it; during an exception it orders the joint to hold at once.
class Stream {
 public:
  ~Stream();
  Stream(Stream&&) noexcept;
  Stream& operator=(Stream&&) = delete;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Orders `position_rad` for time `t_s`, with velocity and acceleration at that time if they are known. Times rise by 0.5 s at most; the
  /// first is `ahead_s` from now. Waits until the sample is due, `ahead_s` before its time, so that a loop over t runs at the joint's
  /// pace. Returns false for a sample after its time, which is left out. Throws Refused, Faulted, Yielded, NotDone (also when the stream
  /// is over), NoAnswer, InvalidInput.
  bool put(double t_s, double position_rad, std::optional<double> velocity_rad_s = {},
           std::optional<double> acceleration_rad_s2 = {}, const CarriedLoad& load = {});

  /// Waits for the last sample's time, ends the stream and waits until the joint holds. If that fails, orders the joint to hold, then
  /// throws the error. The destructor does the same, once, but reports no error.
  void close();

  /// Returns the daemon's cycle for a sample of time `t_s`, to compare orders with the `cycle` of states. Throws NotDone before the first
  /// put(), which sets the time, and InvalidInput for a `t_s` beyond -1e12 to 1e12.
  std::int64_t cycle_of(double t_s) const;

  /// Number of samples that came after their time: left out, or refused by the daemon (34).
  long late() const noexcept { return late_; }
  /// Number of samples that the daemon refused because they quoted an old state (30): the program receives states too late.
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
  std::optional<std::int64_t> last_cycle_;  ///< of the last sample sent; nothing: not begun, or over
  std::int64_t first_cycle_ = 0;            ///< of the stream's first sample
  std::int64_t session_id_ = 0;             ///< of the daemon at the stream's begin
  bool over_ = false;                       ///< closed, or ended by another order
  long late_ = 0;
  long outdated_ = 0;
  int exceptions_;  ///< in flight when the stream was made
};

}  // namespace strainwave
