// SPDX-License-Identifier: BSD-3-Clause
// Losses warm the joint above its surroundings, and the temperature sensor lags behind. The model has one
// thermal mass and one first-order sensor, each advanced exactly over a period. Real-time safe. Source:
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

  /// Begins a period at this temperature of the surroundings; the sensor takes its sample. At the first call
  /// the sensor is settled.
  void set_ambient(double ambient_temperature_C) noexcept {
    joint_C_ = ambient_temperature_C + rise_C_;
    sensor_C_ = started_ ? sensor_C_ + sensor_fraction_ * (joint_C_ - sensor_C_) : joint_C_;
    started_ = true;
  }
  /// Completes the period with `loss_W` of heat in the joint.
  void add_loss(double loss_W) noexcept { rise_C_ += joint_fraction_ * (resistance_C_W_ * loss_W - rise_C_); }

  double joint_C() const noexcept { return joint_C_; }    ///< temperature that friction depends on
  double sensor_C() const noexcept { return sensor_C_; }  ///< reading of the sensor

 private:
  double resistance_C_W_;
  double joint_fraction_;
  double sensor_fraction_;
  double rise_C_ = 0.0;  ///< rise of the joint above its surroundings
  double joint_C_ = 0.0;
  double sensor_C_ = 0.0;
  bool started_ = false;
};

}  // namespace strainwave
