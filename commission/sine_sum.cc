// SPDX-License-Identifier: BSD-3-Clause
#include "commission/sine_sum.h"

#include <cmath>
#include <numbers>

#include "base/units.h"

namespace strainwave {

namespace {

constexpr double kBase_Hz = 1.5;
constexpr double kLowest_Hz = 3.0;
constexpr double kHighest_Hz = 180.0;

/// The amplitudes sqrt(f_i), and the root mean square of the sum of sines.
struct Amplitudes {
  std::array<double, SineSum::kSines> of = SineSum::frequencies_Hz();
  double root_mean_square = 0.0;
  Amplitudes() {
    double squares = 0.0;
    for (const double frequency_Hz : of) squares += 0.5 * frequency_Hz;
    for (double& one : of) one = std::sqrt(one);
    root_mean_square = std::sqrt(squares);
  }
};

}  // namespace

std::array<double, SineSum::kSines> SineSum::frequencies_Hz() {
  std::array<double, kSines> all{};
  double last = 0.0;
  for (std::size_t i = 0; i < kSines; ++i) {
    const double ideal =
        kLowest_Hz * std::pow(kHighest_Hz / kLowest_Hz, static_cast<double>(i) / (kSines - 1.0));
    last = all[i] = std::max(last + kBase_Hz, kBase_Hz * std::round(ideal / kBase_Hz));
  }
  return all;
}

double SineSum::step() {
  static const std::array<double, kSines> frequencies = frequencies_Hz();
  static const Amplitudes amplitudes;
  const double t = period_s_ * static_cast<double>(periods_++);
  double sum = 0.0;
  for (std::size_t i = 0; i < kSines; ++i) {
    const auto n = static_cast<double>(i);
    sum += amplitudes.of[i] *
           std::sin(kTurn_rad * frequencies[i] * t - std::numbers::pi * n * (n + 1.0) / kSines);
  }
  return sum / amplitudes.root_mean_square;
}

void SineSum::respond(double torque_Nm, double speed_rad_s) {
  const double t = period_s_ * static_cast<double>(periods_ - 1);
  const std::complex<double> turning = std::polar(1.0, -kTurn_rad * kLowest_Hz * t);
  torque_ += torque_Nm * turning;
  speed_ += speed_rad_s * turning;
  if (periods_ % std::lround(1.0 / (kBase_Hz * period_s_)) != 0) return;
  if (good_) {
    whole_torque_ += torque_;
    whole_speed_ += speed_;
  }
  good_ = true;
  torque_ = speed_ = 0.0;
}

void SineSum::restart() {
  periods_ = 0;
  good_ = true;
  torque_ = speed_ = 0.0;
}

std::optional<double> SineSum::inertia_kgm2() const {
  if (std::abs(whole_speed_) == 0.0) return std::nullopt;
  return std::abs(whole_torque_ / whole_speed_) / (kTurn_rad * kLowest_Hz);
}

}  // namespace strainwave
