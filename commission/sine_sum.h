// SPDX-License-Identifier: BSD-3-Clause
// A periodic sum of sines, and the inertia from the response to its lowest one. Not real-time.
//
//   s(t) = c sum over i of sqrt(f_i) sin(2 pi f_i t + phi_i),   c: root mean square 1
//
// The speed of a mass swings in proportion to 1 / f. With equal amplitudes the lowest sine would take the allowed swing, and a light link
// would not show. The frequencies are multiples of 1.5 Hz in nearly equal ratios, from well below to above the resonance of any catalogue
// gear with up to three times its inertia. Phases after Schroeder (IEEE Trans. Inf. Theory 16, 1970) keep the peak low.
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

  /// Value of the sum in the next period.
  double step();
  /// Adds the ordered torque and the measured speed of the same period.
  void respond(double torque_Nm, double speed_rad_s);
  /// Discards the response in this repetition, because the joint stuck.
  void forget_repetition() { good_ = false; }
  /// Begins again and discards the response in an incomplete repetition.
  void restart();

  /// Total inertia from torque and speed at 3 Hz over complete repetitions. Below the link's antiresonance the joint moves as one mass. The
  /// error is about a fifth, since friction and delay are neglected. Nothing before the first complete repetition.
  std::optional<double> inertia_kgm2() const;

 private:
  double period_s_;
  long periods_ = 0;
  bool good_ = true;                                 ///< this repetition counts
  std::complex<double> torque_, speed_;              ///< sums of this repetition
  std::complex<double> whole_torque_, whole_speed_;  ///< sums of complete ones
};

}  // namespace strainwave
