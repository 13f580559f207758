// SPDX-License-Identifier: BSD-3-Clause
// What a gain table says of the joints that its gains are stable on, with all that the proof needs: the box, cut into cells by stiffness
// and link inertia, each with a Lyapunov matrix. Plain structs that can be copied as bytes; real-time safe to read. What is proved of
// them: box_certificate.h.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "control/joint/encoder_side.h"

namespace strainwave {

struct BoxRange {
  double from = 0.0;
  double to = 0.0;  ///< >= from

  bool holds(double value) const noexcept { return value >= from && value <= to; }
};

/// Cells of all delays together, and the delays there may be.
inline constexpr int kMaxBoxCells = 24;
inline constexpr int kMaxBoxDelay = 2;
inline constexpr double kMaxLeadPeriods = 10.0;
/// States of the loop around a joint with a spring (spring_plant.h) without delay; each period of delay adds one, and a lead one.
inline constexpr int kSpringLoopStates = 6;

constexpr int spring_loop_states(int delay_periods, double lead_periods) noexcept {
  return kSpringLoopStates + delay_periods + (lead_periods != 0.0 ? 1 : 0);
}
/// The upper triangle of a cell's P, a row and a column for each state of the loop. `delay_periods` >= 0.
constexpr std::size_t cell_entries(int delay_periods, double lead_periods) noexcept {
  const auto n = static_cast<std::size_t>(spring_loop_states(delay_periods, lead_periods));
  return n * (n + 1) / 2;
}
inline constexpr std::size_t kCellEntries = cell_entries(kMaxBoxDelay, kMaxLeadPeriods);

/// A part of the box with one P; in it stiffness and link inertia may be another at every sample.
struct BoxCell {
  std::int32_t delay_periods = 0;
  BoxRange stiffness_Nm_rad;
  BoxRange link_inertia_kgm2;
  std::array<double, kCellEntries> P{};  ///< upper triangle, row by row; zeros after it
};

/// Rigid: no cells, all but the encoder's side is 0. The friction of the motor's side is the rules' own, from 0 to the largest.
struct CertifiedBox {
  EncoderSide encoder_side = EncoderSide::kMotor;
  double motor_inertia_kgm2 = 0.0;  ///< > 0, one number: of the motor's side, at the joint
  BoxRange link_inertia_kgm2;       ///< > 0
  BoxRange stiffness_Nm_rad;        ///< > 0, every slope of the spring
  BoxRange damping_Nms_rad;         ///< >= 0, of the wind-up's speed
  std::int32_t least_delay = 0;  ///< periods between a torque's computation and its effect, 0..kMaxBoxDelay
  std::int32_t most_delay = 0;
  /// Of the feedback on these joints, 0..kMaxLeadPeriods: scheduled_controller.h. Rigid joints have none.
  double lead_periods = 0.0;
  std::int32_t cell_count = 0;  ///< 0: rigid
  std::array<BoxCell, kMaxBoxCells> cells{};

  bool rigid() const noexcept { return cell_count == 0; }
};

}  // namespace strainwave
