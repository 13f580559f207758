// SPDX-License-Identifier: BSD-3-Clause
// The control law of one joint in the loop, with its state: the table in use, learned friction, held load, estimated
// inertia. Real-time safe except for the constructor. Positions are as the drive counts them.
#pragma once

#include <cstdint>
#include <optional>

#include "control/joint/inertia_estimate.h"
#include "control/joint_controller.h"
#include "daemon/realtime/joint/friction_history.h"
#include "daemon/realtime/joint/joint_drive.h"
#include "daemon/realtime/joint/joint_loop_config.h"
#include "daemon/realtime/loop/cycle_time.h"

namespace strainwave {

struct TableSlot {
  GainTable table;
  std::int64_t id = 0;                 ///< digest
  std::int64_t friction_rules_id = 0;  ///< digest of its friction rules
};

class JointLaw {
 public:
  /// Not real-time safe.
  explicit JointLaw(const JointLoopConfig& config);

  JointController& controller() noexcept { return controller_; }
  const JointController& controller() const noexcept { return controller_; }
  /// The result of this period; zero while the law does not run.
  const JointStep& motion() const noexcept { return motion_; }
  /// Sets the torque to zero, because the law's torque is not safe.
  void refuse_torque() noexcept {
    motion_.output.torque_Nm = 0.0;
    motion_.output.saturated = true;
  }

  /// Takes the table, which outlives its use. Call it only at rest or while the reference stands still.
  void use_table(const TableSlot& slot) noexcept;
  const TableSlot* table() const noexcept { return table_; }

  /// Begins at `velocity_rad_s` with the torque that holds the load. Whatever held the load until now lets go after this period.
  void take_over(double position_rad, double velocity_rad_s) noexcept;
  /// Call it while a brake holds the joint: the law learns nothing and holds the known load. Once the joint moves by a count, the law
  /// controls it.
  void wait_for_brake(double position_rad) noexcept;
  /// One period. `brake_opens`: the previous torque is not used to estimate the inertia.
  void run(const JointDrive& drive, const CycleTime& time, bool brake_opens) noexcept;
  void rest() noexcept { motion_ = {}; }
  /// Stores the holding torque at `position_rad`: the joint rests there, and something else holds it from now on.
  void keep_held_load(double position_rad) noexcept {
    held_ = {controller_.holding_torque_Nm(), position_rad};
  }

  const FrictionHistory& friction_history() const noexcept { return friction_; }
  /// Restores what an earlier run of the daemon learned with the rules of the first table.
  void restore(const LearnedFriction& learned, const FrictionHistory& history) noexcept;
  void forget_learned() noexcept;

  std::optional<double> inertia_kgm2() const noexcept { return inertia_.inertia_kgm2(); }
  /// Whether the estimated inertia differs from the configured one by more than its possible error.
  bool shows_other_inertia() const noexcept;
  /// The evidence of an oscillation, as a number (lcmtypes/oscillation_evidence.h).
  std::uint32_t evidence() const noexcept;

 private:
  /// Torque and position when the joint last rested under control. Before that, the configured load without a position.
  struct HeldLoad {
    double torque_Nm = 0.0;
    std::optional<double> position_rad;
  };
  double load_at_Nm(double position_rad) const noexcept;
  void estimate_inertia(const JointMeasurement& measurement, bool other_torque) noexcept;

  GravityLoad gravity_;
  JointController controller_;
  InertiaEstimate inertia_;
  FrictionHistory friction_;
  HeldLoad held_;
  bool closes_loop_;                  ///< the drive closes its own loop
  const TableSlot* table_ = nullptr;  ///< the active one
  JointStep motion_;
};

}  // namespace strainwave
