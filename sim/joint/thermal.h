// SPDX-License-Identifier: BSD-3-Clause
// Heat: losses warm the joint above its surroundings, and the temperature sensor lags behind. One thermal
// mass, one first-order sensor, each advanced exactly over a period. Real-time safe. Source:
// data/rhs17_datasheet.csv (thermal resistance 1.2 degC/W, time constant 16 min).
#pragma once

#include <cmath>

namespace strainwave {

struct ThermalParameters {
  double resistance_C_W = 0.0;          ///< joint to surroundings; 0: losses do not warm the joint
  double time_constant_s = 960.0;       ///< > 0
  double sensor_time_constant_s = 0.0;  ///< 0: the sensor follows at once
};

class ThermalModel {
 public:
  ThermalModel(const ThermalParameters& parameters, double period_s) noexcept
      : resistance_C_W_(parameters.resistance_C_W),
        joint_fraction_(-std::expm1(-period_s / parameters.time_constant_s)),
        sensor_fraction_(parameters.sensor_time_constant_s > 0.0
                             ? -std::expm1(-period_s / parameters.sensor_time_constant_s)
                             : 1.0) {}

  /// Start of a period: the surroundings are at `ambient_temperature_C`; the sensor takes its sample. The first call
  /// finds the sensor settled.
  void set_ambient(double ambient_temperature_C) noexcept {
    joint_C_ = ambient_temperature_C + rise_C_;
    sensor_C_ = started_ ? sensor_C_ + sensor_fraction_ * (joint_C_ - sensor_C_) : joint_C_;
    started_ = true;
  }
  /// The rest of the period, with `loss_W` of heat in the joint.
  void add_loss(double loss_W) noexcept { rise_C_ += joint_fraction_ * (resistance_C_W_ * loss_W - rise_C_); }

  double joint_C() const noexcept { return joint_C_; }    ///< where the friction is
  double sensor_C() const noexcept { return sensor_C_; }  ///< what the sensor shows

 private:
  double resistance_C_W_;
  double joint_fraction_;
  double sensor_fraction_;
  double rise_C_ = 0.0;  ///< joint above surroundings
  double joint_C_ = 0.0;
  double sensor_C_ = 0.0;
  bool started_ = false;
};

}  // namespace strainwave
