// SPDX-License-Identifier: BSD-3-Clause
// A drive on a bus that shares no code with control/ and sim/. Its joint is an inertia with static friction, in
// explicit steps of 0.2 ms. With each SYNC it samples its position and takes the newest torque, in its own resolution.
// Settings: delay of the SYNC, number of SYNCs until a torque acts, delay and jitter of positions. Virtual time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numbers>
#include <random>
#include <vector>

#include "drivers/actuator.h"
#include "drivers/can/sample_age.h"

namespace strainwave::testing {

struct StrictJointData {
  double inertia_kgm2 = 0.089;
  double static_Nm = 1.6;
  double coulomb_Nm = 0.8;
  double viscous_Nms_rad = 0.3;
  double stribeck_rad_s = 0.042;
};

class StrictJoint {
 public:
  explicit StrictJoint(const StrictJointData& data) : data_(data) {}

  void advance(double torque_Nm, double duration_s) {
    const int steps = std::max(1, static_cast<int>(std::lround(duration_s / 2e-4)));
    for (int i = 0; i < steps; ++i) step(torque_Nm, duration_s / steps);
  }
  double position_rad() const { return position_rad_; }
  double velocity_rad_s() const { return velocity_rad_s_; }

 private:
  void step(double torque_Nm, double step_s) {
    if (velocity_rad_s_ == 0.0 && std::abs(torque_Nm) <= data_.static_Nm) return;
    const double ratio = velocity_rad_s_ / data_.stribeck_rad_s;
    const double curve_Nm =
        data_.coulomb_Nm + (data_.static_Nm - data_.coulomb_Nm) * std::exp(-ratio * ratio);
    const double along = velocity_rad_s_ != 0.0 ? velocity_rad_s_ : torque_Nm;
    const double friction_Nm = std::copysign(curve_Nm, along) + data_.viscous_Nms_rad * velocity_rad_s_;
    const double next_rad_s = velocity_rad_s_ + (torque_Nm - friction_Nm) / data_.inertia_kgm2 * step_s;
    velocity_rad_s_ = velocity_rad_s_ * next_rad_s < 0.0 ? 0.0 : next_rad_s;
    position_rad_ += velocity_rad_s_ * step_s;
  }

  StrictJointData data_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
};

struct StrictDriveData {
  StrictJointData joint;
  double period_s = 0.001;
  int torque_lag = 0;              ///< SYNCs after the next one until a torque acts
  double sync_after_s = 2e-4;      ///< from the beginning of a period to its SYNC
  double sync_jitter_s = 0.0;      ///< largest, uniformly distributed
  double position_delay_s = 1e-4;  ///< from SYNC to TPDO
  double position_jitter_s = 0.0;  ///< largest additional delay, uniformly distributed
  double lost_share = 0.0;         ///< share of positions that are lost
  double torque_step_Nm = 0.0096;  ///< a thousandth of the rated torque
  double counts_per_revolution = 320000.0;
  std::uint64_t seed = 1;
};

class StrictDrive final : public Actuator {
 public:
  explicit StrictDrive(const StrictDriveData& data)
      : data_(data),
        joint_(data.joint),
        random_(data.seed),
        acting_Nm_(static_cast<std::size_t>(data.torque_lag) + 1, 0.0),
        age_(nanoseconds(data.period_s), 1) {
    age_.restart(nanoseconds(data.position_delay_s));
  }

  ActuatorReading read(std::int64_t now_ns) noexcept override {
    turn(now_ns);
    ActuatorReading reading;
    for (; !telling_.empty() && telling_.front().at_ns <= now_ns; telling_.pop_front()) {
      for (; next_sync_ < syncs_ns_.size() && syncs_ns_[next_sync_] <= telling_.front().at_ns; ++next_sync_)
        age_.sync(syncs_ns_[next_sync_]);
      age_.sample(telling_.front().at_ns);
      told_rad_ = telling_.front().position_rad;
      reading.has_position = true;
    }
    missed_ += reading.has_position ? 0 : 1;
    reading.joint_position_rad = told_rad_;
    reading.position_delay_ns = reading.has_position ? age_.delay_ns() : 0;
    const auto periods = static_cast<int>((now_ns - now_ns_) / nanoseconds(data_.period_s));
    reading.position_late_periods = age_.late_periods(now_ns_ > 0 ? periods - 1 : 0);
    reading.has_temperature = true;
    reading.temperature_C = 25.3;
    reading.temperature_produced_ns = now_ns;
    reading.drive_state = enabled_ ? DriveState::kEnabled : DriveState::kDisabled;
    now_ns_ = now_ns;
    return reading;
  }
  /// The SYNC follows. Periods that the loop skips have none.
  void write(const ActuatorCommand& command) noexcept override {
    enabled_ = command.enable;
    const double wanted_Nm = command.enable ? command.torque_Nm : 0.0;
    order_Nm_ = std::nearbyint(wanted_Nm / data_.torque_step_Nm) * data_.torque_step_Nm;
    sync_ns_ = now_ns_ + nanoseconds(data_.sync_after_s + drawn(data_.sync_jitter_s));
    due_ = true;
  }
  void stop() noexcept override {
    enabled_ = false;
    order_Nm_ = 0.0;
  }
  void clear_fault() noexcept override {}

  const StrictJoint& joint() const { return joint_; }
  double order_Nm() const { return order_Nm_; }
  int missed() const { return missed_; }

 private:
  struct Told {
    std::int64_t at_ns = 0;
    double position_rad = 0.0;
  };
  static std::int64_t nanoseconds(double s) { return std::llround(s * 1e9); }
  double drawn(double most) {
    return most > 0.0 ? std::uniform_real_distribution<double>(0.0, most)(random_) : 0.0;
  }

  /// Applies the SYNC of the last period if its time has come.
  void turn(std::int64_t now_ns) {
    if (!due_ || sync_ns_ > now_ns) return;
    due_ = false;
    if (last_sync_ns_ != 0)
      joint_.advance(acting_Nm_.front(), static_cast<double>(sync_ns_ - last_sync_ns_) * 1e-9);
    last_sync_ns_ = sync_ns_;
    acting_Nm_.push_back(order_Nm_);
    acting_Nm_.pop_front();
    syncs_ns_.push_back(sync_ns_);
    const double count_rad = 2.0 * std::numbers::pi / data_.counts_per_revolution;
    const double position_rad = std::nearbyint(joint_.position_rad() / count_rad) * count_rad;
    if (drawn(1.0) < data_.lost_share) return;
    std::int64_t at_ns = sync_ns_ + nanoseconds(data_.position_delay_s + drawn(data_.position_jitter_s));
    if (!telling_.empty()) at_ns = std::max(at_ns, telling_.back().at_ns + 1);
    telling_.push_back({at_ns, position_rad});
  }

  StrictDriveData data_;
  StrictJoint joint_;
  std::mt19937_64 random_;
  std::deque<double> acting_Nm_;  ///< the first one acts now
  std::deque<Told> telling_;
  std::vector<std::int64_t> syncs_ns_;
  std::size_t next_sync_ = 0;
  SampleAge age_;
  std::int64_t now_ns_ = 0;
  std::int64_t sync_ns_ = 0;
  std::int64_t last_sync_ns_ = 0;
  double order_Nm_ = 0.0;
  double told_rad_ = 0.0;
  int missed_ = 0;
  bool due_ = false;
  bool enabled_ = false;
};

}  // namespace strainwave::testing
