// SPDX-License-Identifier: BSD-3-Clause
// Position of the encoder's index pulse. Each edge carries the time of its interrupt, and the position is
// interpolated linearly between two samples. Real-time safe.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"
#include "drivers/gpio/edge_events.h"

namespace strainwave {

class IndexCapture {
 public:
  /// A pulse began at `time_ns`; the next sample() determines its position.
  void pulse(std::int64_t time_ns) noexcept;
  /// Takes the sample of this period, after its pulses.
  void sample(double joint_position_rad, std::int64_t now_ns) noexcept;
  void fill(JointInputs& inputs) const noexcept {
    inputs.index_count = count_;
    inputs.index_position_rad = position_rad_;
  }

 private:
  std::int64_t count_ = 0;
  double position_rad_ = 0.0;
  std::int64_t pending_ns_ = 0;  ///< time of a pulse without a position yet; 0: none
  double last_position_rad_ = 0.0;
  std::int64_t last_ns_ = 0;
};

inline void IndexCapture::pulse(std::int64_t time_ns) noexcept {
  if (pending_ns_ == 0) pending_ns_ = time_ns;
}

inline void IndexCapture::sample(double joint_position_rad, std::int64_t now_ns) noexcept {
  if (pending_ns_ != 0 && now_ns > last_ns_) {
    const double share = static_cast<double>(pending_ns_ - last_ns_) / static_cast<double>(now_ns - last_ns_);
    const double within = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    position_rad_ = last_position_rad_ + within * (joint_position_rad - last_position_rad_);
    ++count_;
    pending_ns_ = 0;
  }
  last_position_rad_ = joint_position_rad;
  last_ns_ = now_ns;
}

}  // namespace strainwave
