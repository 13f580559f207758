// SPDX-License-Identifier: BSD-3-Clause
// The joints on which the gains of a table are stable, with the data of the proof. The box is cut into cells by stiffness and link
// inertia, each with a Lyapunov matrix. A rigid joint's box has one cell for each delay. Plain structs that can be copied as
// bytes; real-time safe to read. The proof is in box_certificate.h.
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
  bool holds(const BoxRange& part) const noexcept { return from <= part.from && to >= part.to; }
  bool operator==(const BoxRange&) const = default;
};

/// Limits for the cells of all delays together, for the delay and for the lead.
inline constexpr int kMaxBoxCells = 24;
inline constexpr int kMaxBoxDelay = 2;
inline constexpr double kMaxLeadPeriods = 10.0;
/// A proof may halve a cell, and its halves again, this many times.
inline constexpr int kMostHalvings = 8;
/// States of the plant (spring_plant.h): those of a motor, and with a spring also those of the wind-up.
inline constexpr int kRigidPlantStates = 2;
inline constexpr int kSpringPlantStates = 4;

/// States of the loop: the plant's, the integral, the last reading, one for each period of delay, and one for a lead.
constexpr int loop_states(int plant_states, int delay_periods, double lead_periods) noexcept {
  return plant_states + 2 + delay_periods + (lead_periods != 0.0 ? 1 : 0);
}
constexpr std::size_t triangle_entries(int states) noexcept {
  return static_cast<std::size_t>(states) * static_cast<std::size_t>(states + 1) / 2;
}
inline constexpr std::size_t kCellEntries =
    triangle_entries(loop_states(kSpringPlantStates, kMaxBoxDelay, kMaxLeadPeriods));

/// A part of the box with one P. In it stiffness and both inertias may change at every sample. The motor's inertia is the box's.
struct BoxCell {
  std::int32_t delay_periods = 0;
  BoxRange stiffness_Nm_rad;
  BoxRange link_inertia_kgm2;
  /// Upper triangle, row by row, a row for each state of the loop; zeros beyond it, and in the integral's row without an integrator.
  std::array<double, kCellEntries> P{};

  bool operator==(const BoxCell&) const = default;
};

/// A rigid joint has 0 for inertias, stiffness, damping and lead, also in the cells; its inertia is the table's. Without a cell nothing is
/// proved. Viscous friction of the motor ranges from 0 to the largest of the rules.
struct CertifiedBox {
  EncoderSide encoder_side = EncoderSide::kMotor;
  BoxRange motor_inertia_kgm2;   ///< > 0, of the motor's side, at the joint
  BoxRange link_inertia_kgm2;    ///< > 0
  BoxRange stiffness_Nm_rad;     ///< > 0, every slope of the spring
  BoxRange damping_Nms_rad;      ///< >= 0, of the wind-up's speed
  std::int32_t least_delay = 0;  ///< periods between a torque's computation and its effect, 0..kMaxBoxDelay
  std::int32_t most_delay = 0;
  /// Lead of the feedback on these joints, 0..kMaxLeadPeriods (scheduled_controller.h). Rigid joints have none.
  double lead_periods = 0.0;
  std::int32_t cell_count = 0;
  std::array<BoxCell, kMaxBoxCells> cells{};

  bool rigid() const noexcept { return link_inertia_kgm2.to == 0.0; }
  int plant_states() const noexcept { return rigid() ? kRigidPlantStates : kSpringPlantStates; }
  std::size_t entries_of(const BoxCell& cell) const noexcept {
    return triangle_entries(loop_states(plant_states(), cell.delay_periods, lead_periods));
  }
  bool operator==(const CertifiedBox&) const = default;
};

}  // namespace strainwave
