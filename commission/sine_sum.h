// SPDX-License-Identifier: BSD-3-Clause
// A sum of sines, periodic, and the inertia that the response to its lowest one shows. Not real-time.
//
//   s(t) = c sum over i of sqrt(f_i) sin(2 pi f_i t + phi_i),   c: root mean square 1
//
// A torque moves a mass by 1 / f: equal ones would spend the speed that may swing on the lowest, and show nothing of a light link.
// The frequencies are multiples of 1.5 Hz, in equal ratios as near as these come, from well below to beyond the resonance of any gear of
// the catalogue with up to three times its inertia. Phases after Schroeder (IEEE Trans. Inf. Theory 16, 1970) keep the peak low.
#pragma once

#include <array>
#include <complex>
#include <optional>

namespace strainwave {

class SineSum {
 public:
  static constexpr std::size_t kSines = 28;
  static std::array<double, kSines> frequencies_Hz();

  explicit SineSum(double period_s) : period_s_(period_s) {}

  /// Of the next period.
  double step();
  /// In the same period: what was ordered and what the joint did.
  void respond(double torque_Nm, double speed_rad_s);
  /// What responded in this repetition does not count: the joint stuck.
  void forget_repetition() { good_ = false; }
  /// Begins again; what responded in a repetition that is not whole is forgotten.
  void restart();

  /// Total inertia, by torque and speed at 3 Hz over whole repetitions: below the link's antiresonance the joint is one mass. To about a
  /// fifth, since friction and delay are left out. Nothing before a repetition is whole.
  std::optional<double> inertia_kgm2() const;

 private:
  double period_s_;
  long periods_ = 0;
  bool good_ = true;                                 ///< this repetition
  std::complex<double> torque_, speed_;              ///< of this repetition
  std::complex<double> whole_torque_, whole_speed_;  ///< of those before
};

}  // namespace strainwave
