// SPDX-License-Identifier: BSD-3-Clause
// A second, independent model of a joint with a spring, without code of control/ or sim/. Two masses move in fine semi-implicit steps, with the
// gear's three slopes, the supply's limit, a delay in whole periods and an encoder with counts. The motor's Stribeck friction sticks and breaks
// away, or first gives way like a spring. Findings on the simulator's joint, which has another integrator, must hold here as well.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>

namespace strainwave {

struct TwoMassData {
  double motor_kgm2 = 0.089;
  double link_kgm2 = 0.0;  ///< 0: rigid
  std::array<double, 3> slopes_Nm_rad{1e4, 1e4, 1e4};
  std::array<double, 2> corners_Nm{0.0, 0.0};  ///< torques between the slopes
  double damping_Nms_rad = 1.0;
  double static_Nm = 1.6;
  double coulomb_Nm = 0.8;
  double viscous_Nms_rad = 0.3;
  double stribeck_rad_s = 0.0;  ///< 0: Coulomb friction as soon as it moves
  double presliding_rad =
      0.0;  ///< > 0: up to so far static friction is a spring, with a damper; 0: it sticks
  double presliding_damping_Nms_rad = 0.0;
  double peak_Nm = 34.0;
  double stall_Nm = 1e9;
  double torque_per_speed_Nms_rad = 0.0;
  int delay_periods = 1;
  double counts_per_revolution = 320000.0;
  bool encoder_on_link = false;
};

class TwoMassJoint {
 public:
  static constexpr double kPeriod_s = 1e-3;

  explicit TwoMassJoint(const TwoMassData& data)
      : data_(data), pending_(static_cast<std::size_t>(data.delay_periods), 0.0) {}

  /// `push_Nm`: external torque on the link.
  void step(double torque_Nm, double push_Nm = 0.0) {
    push_Nm_ = push_Nm;
    pending_.push_back(torque_Nm);
    const double acting_Nm = pending_.front();
    pending_.pop_front();
    constexpr int kSubsteps = 200;
    for (int k = 0; k < kSubsteps; ++k) advance(acting_Nm, kPeriod_s / kSubsteps);
  }
  double count_rad() const { return 2.0 * std::numbers::pi / data_.counts_per_revolution; }
  double reading_rad() const {
    const double position_rad = data_.encoder_on_link && data_.link_kgm2 > 0.0 ? link_rad_ : motor_rad_;
    return std::nearbyint(position_rad / count_rad()) * count_rad();
  }
  double motor_rad() const { return motor_rad_; }
  double link_rad() const { return data_.link_kgm2 > 0.0 ? link_rad_ : motor_rad_; }
  bool moves() const { return motor_rad_s_ != 0.0; }

 private:
  double spring_Nm(double wind_up_rad) const {
    double left_rad = std::abs(wind_up_rad);
    double torque_Nm = 0.0;
    double corner_Nm = 0.0;
    for (std::size_t i = 0; i < 2; ++i) {
      const double width_rad = (data_.corners_Nm[i] - corner_Nm) / data_.slopes_Nm_rad[i];
      const double part_rad = std::min(left_rad, width_rad);
      torque_Nm += part_rad * data_.slopes_Nm_rad[i];
      left_rad -= part_rad;
      corner_Nm = data_.corners_Nm[i];
    }
    return std::copysign(torque_Nm + left_rad * data_.slopes_Nm_rad[2], wind_up_rad);
  }
  double motor_Nm(double wanted_Nm) const {
    const double slowed_Nm = data_.torque_per_speed_Nms_rad * motor_rad_s_;
    const double highest_Nm = std::min(data_.peak_Nm, data_.stall_Nm - slowed_Nm);
    const double lowest_Nm = std::max(-data_.peak_Nm, -data_.stall_Nm - slowed_Nm);
    return std::max(lowest_Nm, std::min(highest_Nm, wanted_Nm));
  }
  double friction_Nm() const {
    const double speed_rad_s = std::abs(motor_rad_s_);
    double dry_Nm = data_.coulomb_Nm;
    if (data_.stribeck_rad_s > 0.0) {
      const double ratio = speed_rad_s / data_.stribeck_rad_s;
      if (ratio < 6.0) dry_Nm += (data_.static_Nm - data_.coulomb_Nm) * std::exp(-ratio * ratio);
    }
    return dry_Nm + data_.viscous_Nms_rad * speed_rad_s;
  }
  void advance(double torque_Nm, double duration_s) {
    double transmitted_Nm = 0.0;
    if (data_.link_kgm2 > 0.0) {
      transmitted_Nm =
          spring_Nm(motor_rad_ - link_rad_) + data_.damping_Nms_rad * (motor_rad_s_ - link_rad_s_);
      link_rad_s_ += duration_s / data_.link_kgm2 * (transmitted_Nm + push_Nm_);
      link_rad_ += duration_s * link_rad_s_;
    }
    const double driving_Nm = motor_Nm(torque_Nm) - (data_.link_kgm2 > 0.0 ? transmitted_Nm : -push_Nm_);
    if (data_.presliding_rad > 0.0) return slide_elastically(driving_Nm, duration_s);
    if (motor_rad_s_ == 0.0 && std::abs(driving_Nm) <= data_.static_Nm) return;
    const double direction = std::copysign(1.0, motor_rad_s_ != 0.0 ? motor_rad_s_ : driving_Nm);
    const double next_rad_s =
        motor_rad_s_ + duration_s / data_.motor_kgm2 * (driving_Nm - direction * friction_Nm());
    motor_rad_s_ = next_rad_s * direction < 0.0 ? 0.0 : next_rad_s;
    motor_rad_ += duration_s * motor_rad_s_;
  }

  // A spring whose end is dragged along at its largest deflection.
  void slide_elastically(double driving_Nm, double duration_s) {
    const double end_rad = data_.presliding_rad;
    deflection_rad_ = std::clamp(deflection_rad_ + duration_s * motor_rad_s_, -end_rad, end_rad);
    const bool sticks = std::abs(deflection_rad_) < end_rad;
    const double damping_Nm = sticks ? data_.presliding_damping_Nms_rad * motor_rad_s_ : 0.0;
    const double friction_Nm =
        (sticks ? data_.static_Nm : this->friction_Nm()) * deflection_rad_ / end_rad + damping_Nm;
    motor_rad_s_ += duration_s / data_.motor_kgm2 * (driving_Nm - friction_Nm);
    motor_rad_ += duration_s * motor_rad_s_;
  }

  TwoMassData data_;
  std::deque<double> pending_;
  double motor_rad_ = 0.0, motor_rad_s_ = 0.0, link_rad_ = 0.0, link_rad_s_ = 0.0;
  double deflection_rad_ = 0.0;
  double push_Nm_ = 0.0;
};

}  // namespace strainwave
