// SPDX-License-Identifier: BSD-3-Clause
// The control law of one joint in the loop, with what it needs around it: the table in use, what was learned,
// the load that held the joint, the inertia that its motions show. Real-time safe but for the constructor. Positions are the drive's.
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
  /// Of this period; zero while the law does not run.
  const JointStep& motion() const noexcept { return motion_; }
  /// Another torque than the law's is safer: none.
  void refuse_torque() noexcept {
    motion_.output.torque_Nm = 0.0;
    motion_.output.saturated = true;
  }

  /// At rest or while the reference stands still: takes the table, which outlives its use.
  void use_table(const TableSlot& slot) noexcept;
  const TableSlot* table() const noexcept { return table_; }

  /// Begins at `velocity_rad_s` with the torque that holds the load: what held it until now lets go after this period.
  void take_over(double position_rad, double velocity_rad_s) noexcept;
  /// A brake holds the joint at its place, whatever the torque: nothing can be learned, and the load that is known is held. The first
  /// count that it moves is the law's.
  void wait_for_brake(double position_rad) noexcept;
  /// One period. `brake_opens`: the torque of before says nothing of the inertia.
  void run(const JointDrive& drive, const CycleTime& time, bool brake_opens) noexcept;
  void rest() noexcept { motion_ = {}; }
  /// The joint has come to rest here, and something else holds it from here on.
  void keep_held_load(double position_rad) noexcept {
    held_ = {controller_.holding_torque_Nm(), position_rad};
  }

  const FrictionHistory& friction_history() const noexcept { return friction_; }
  /// What an earlier run of the daemon learned, with the rules of the first table.
  void restore(const LearnedFriction& learned, const FrictionHistory& history) noexcept;
  void forget_learned() noexcept;

  std::optional<double> inertia_kgm2() const noexcept { return inertia_.inertia_kgm2(); }
  /// The inertia that motions show is another one than configured, by more than the estimate may be off.
  bool shows_other_inertia() const noexcept;
  /// Of a joint that oscillates (lcmtypes/oscillation_evidence.h).
  std::uint32_t evidence() const noexcept;

 private:
  /// The torque that held the joint when it last rested under control, and where that was; before, the configuration's.
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
  bool closes_loop_;                  ///< the drive, by itself
  const TableSlot* table_ = nullptr;  ///< the active one
  JointStep motion_;
};

}  // namespace strainwave
