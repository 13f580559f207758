// On which side of the joint friction is compensated while a stream is followed, and how much of it. A stream that is to stand may
// dither by nanometres, or by a count of the encoder that it is read from, and turns round each time: by the sign of its velocity all of
// static friction would be thrown to and fro. What turns friction round is way:
//
//   share' = clamp(share + travel / width, -1, 1)
//   share' = sign(travel)                            where the motion goes on for four widths or more, as far as it is known
//
// Real-time safe.
#pragma once

#include <algorithm>
#include <cmath>

namespace strainwave {

class FrictionSide {
 public:
  /// Way from none of it to all of it, > 0; the joint has turned friction round after twice that.
  explicit FrictionSide(double width_rad) noexcept : width_rad_(width_rad) {}

  void reset() noexcept { share_ = 0.0; }
  /// What the reference has gone in this period, and will go as far as is known.
  void move(double travel_rad, double ahead_rad) noexcept {
    const bool goes_on = travel_rad * ahead_rad > 0.0 && std::abs(ahead_rad) >= kGoesOn * width_rad_;
    share_ =
        goes_on ? std::copysign(1.0, travel_rad) : std::clamp(share_ + travel_rad / width_rad_, -1.0, 1.0);
  }
  /// Of friction, with the sign of the torque against it, -1..1.
  double share() const noexcept { return share_; }

 private:
  static constexpr double kGoesOn = 4.0;
  double width_rad_;
  double share_ = 0.0;
};

}  // namespace strainwave
