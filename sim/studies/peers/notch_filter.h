// SPDX-License-Identifier: BSD-3-Clause
// The notch in a servo drive's torque removes a band around one frequency, completely in its middle, and passes all else.
// Real-time safe. Sources: Siemens, SINAMICS S120 function manual "Drive functions" (current setpoint filter, band-stop with
// infinite notch depth: numerator damping 0, denominator damping bandwidth / 2 f); HIWIN E1 user manual 10.6.3 (bandwidth
// f / Q). The discretisation is bilinear with a pre-warped frequency, as Synapticon's object 0x2023.
//
//   N(s) = (s^2 + w^2) / (s^2 + b w s + w^2)             b: width at -3 dB over w; slower signals are late by b / w
//   s    = c (z - 1) / (z + 1),   c = w / tan(w h / 2)   so that the zero stays at w
//   y    = [ u - 2 cos(w h) (u(1 ago) - y(1 ago)) + u(2 ago) - (1 - g) y(2 ago) ] / (1 + g),   g = b / 2 sin(w h)
#pragma once

#include <array>

namespace strainwave {

class NotchFilter {
 public:
  /// `frequency_rad_s` in (0, pi / period_s); `width_share` > 0: the width at -3 dB over that frequency.
  NotchFilter(double frequency_rad_s, double width_share, double period_s) noexcept;
  double step(double input) noexcept;
  /// Resets to the state after an endless input of 0.
  void reset() noexcept;

 private:
  double cosine_;                   ///< 2 cos(w h)
  double width_;                    ///< g
  std::array<double, 2> inputs_{};  ///< newest first
  std::array<double, 2> outputs_{};
};

}  // namespace strainwave
