// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/motion_windows.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Short enough to pass a swing of 50 Hz, and long enough to average the encoder's counts.
constexpr double kWindow_s = 0.014;
constexpr int kLeastWindowSamples = 14;
constexpr double kSlow_rad_s = 0.08;  // above the Stribeck range of the catalogue's joints
constexpr double kMostSlow = 0.2;     // share of a window

/// phi(s) = (1 - s^2)^4 on -1..1 and its derivatives.
struct Bump {
  double value = 0.0, first = 0.0, second = 0.0;
  explicit Bump(double s) {
    const double u = 1.0 - s * s;
    if (u <= 0.0) return;
    value = u * u * u * u;
    first = -8.0 * s * u * u * u;
    second = -8.0 * u * u * u + 48.0 * s * s * u * u;
  }
};

}  // namespace

MotionWindows::MotionWindows(const Evidence& evidence)
    : evidence_(evidence), stretches_(controlled_stretches(evidence)) {
  if (stretches_.empty()) return;
  step_s_ = stretches_.front().step_s;
  half_ = std::max(static_cast<int>(std::lround(0.5 * kWindow_s / step_s_)), kLeastWindowSamples / 2);
  for (const Stretch& stretch : stretches_) find_windows(stretch);
}

void MotionWindows::find_windows(const Stretch& stretch) {
  const int count = static_cast<int>(stretch.position_rad.size());
  const int hop = std::max(1, half_ / 2);
  const int margin = half_ + static_cast<int>(std::ceil((kMostDelay + 1) * evidence_.period_s / step_s_));
  for (int center = margin; center + half_ < count; center += hop) {
    int slow = 0;
    bool usable = true;
    for (int i = center - half_; i <= center + half_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      slow += std::abs(stretch.velocity_rad_s[at]) < kSlow_rad_s ? 1 : 0;
      usable = usable && !stretch.torque_lost(at);
    }
    if (usable && slow <= kMostSlow * (2 * half_ + 1)) windows_.push_back({&stretch, center});
  }
}

// A torque that was commanded in period k acts from k + d on, for a period.
Eigen::VectorXd MotionWindows::torques(double delay_periods) const {
  Eigen::VectorXd sums(static_cast<Eigen::Index>(windows_.size()));
  const double shift = (delay_periods + 0.5) * evidence_.period_s / step_s_;
  const int reach = static_cast<int>(std::ceil(shift)) + half_;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    double sum = 0.0;
    for (int i = -reach; i <= half_; ++i) {
      const int at = windows_[w].center + i;
      sum += Bump((i + shift) / half_).value * windows_[w].stretch->torque_Nm[static_cast<std::size_t>(at)];
    }
    sums[static_cast<Eigen::Index>(w)] = sum / normaliser();
  }
  return sums;
}

MotionRows MotionWindows::rows(double scale) const {
  MotionRows rows(static_cast<Eigen::Index>(windows_.size()), kMotionColumns);
  const Stretch* at = nullptr;
  std::array<std::vector<double>, 5> link;
  const double half_s = half_ * step_s_;
  for (std::size_t w = 0; w < windows_.size(); ++w) {
    const Stretch& stretch = *windows_[w].stretch;
    if (flexible() && at != &stretch) link = link_responses(stretch, scale);
    at = &stretch;
    Eigen::Matrix<double, kMotionColumns, 1> row = Eigen::Matrix<double, kMotionColumns, 1>::Zero();
    for (int i = -half_; i <= half_; ++i) {
      const Bump bump(static_cast<double>(i) / half_);
      const int sample = windows_[w].center + i;
      const auto k = static_cast<std::size_t>(sample);
      const double position_rad =
          stretch.position_rad[k] - stretch.position_rad[static_cast<std::size_t>(windows_[w].center)];
      row[kMotor] += bump.second / (half_s * half_s) * position_rad;
      for (int i_link = 0; flexible() && i_link < 5; ++i_link)
        row[i_link == 0 ? kLink : kError + i_link - 1] +=
            bump.value * link[static_cast<std::size_t>(i_link)][k];
      row[kCoulomb] += bump.value * std::copysign(1.0, stretch.velocity_rad_s[k]);
      row[kViscous] -= bump.first / half_s * position_rad;
      row[kBias] += bump.value;
      row[kSine] += bump.value * std::sin(stretch.position_rad[k]);
      row[kCosine] += bump.value * std::cos(stretch.position_rad[k]);
    }
    rows.row(static_cast<Eigen::Index>(w)) = row.transpose() / normaliser();
  }
  return rows;
}

// Responses of the link to the motor's motion with the assumed error, and to 0.1 mrad more of each part of the error. The slope of the
// error changes the gear's ratio, and with it the share of the link's torque that acts on the motor.
std::array<std::vector<double>, 5> MotionWindows::link_responses(const Stretch& stretch, double scale) const {
  const ConfiguredLink& told = *evidence_.told.link;
  const double ratio = evidence_.gear_ratio();
  std::array<std::vector<double>, 5> drives_rad;
  std::vector<double> load_Nm, lead;
  for (const double position_rad : stretch.position_rad) {
    const double turn_rad = ratio * position_rad;
    const std::array parts{std::sin(turn_rad), std::cos(turn_rad), std::sin(2.0 * turn_rad),
                           std::cos(2.0 * turn_rad)};
    const std::array slopes{parts[1], -parts[0], 2.0 * parts[3], -2.0 * parts[2]};
    double error_rad = 0.0, slope = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      error_rad += assumed_.error_rad[i] * parts[i];
      slope += assumed_.error_rad[i] * slopes[i];
    }
    drives_rad[0].push_back(position_rad + error_rad);
    for (std::size_t i = 0; i < 4; ++i)
      drives_rad[i + 1].push_back(position_rad + error_rad + kErrorUnit_rad * parts[i]);
    lead.push_back(1.0 + ratio * slope);
    load_Nm.push_back(assumed_.bias_Nm + assumed_.sine_Nm * std::sin(position_rad) +
                      assumed_.cosine_Nm * std::cos(position_rad));
  }
  std::array<std::vector<double>, 5> responses;
  for (std::size_t part = 0; part < 5; ++part)
    responses[part] = link_acceleration(drives_rad[part], load_Nm, stretch.step_s, told, scale);
  for (std::size_t k = 0; k < lead.size(); ++k) {
    for (std::size_t part = 1; part < 5; ++part) responses[part][k] -= responses[0][k];
    responses[0][k] += (lead[k] - 1.0) * (responses[0][k] + load_Nm[k] / told.link_inertia_kgm2);
  }
  return responses;
}

std::vector<double> MotionWindows::positions_rad() const {
  std::vector<double> positions;
  for (const Window& window : windows_)
    positions.push_back(window.stretch->position_rad[static_cast<std::size_t>(window.center)]);
  return positions;
}

// The integral of phi over -1..1 is 256 / 315.
double MotionWindows::normaliser() const noexcept {
  return half_ * 256.0 / 315.0;
}

}  // namespace strainwave
