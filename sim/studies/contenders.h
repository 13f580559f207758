// SPDX-License-Identifier: BSD-3-Clause
// Who takes part in a comparison: the PID of Zhao (2006), the plain table controllers C1..C4, and C4 as the daemon
// runs it. Offline.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "control/joint_controller.h"
#include "control/table/gain_table.h"
#include "sim/studies/closed_loop.h"
#include "sim/studies/loop_controllers.h"

namespace strainwave {

/// A named way to make a controller for a plant.
struct Contender {
  std::string name;
  std::function<std::unique_ptr<LoopController>(const JointPlantConfig&)> make;
};

/// C1..C4 of `table`'s primary gains: the bare control law of control/scheduled_controller.h, setpoints as
/// steps, limited by the plant's peak torque. Throws InputError when a run's period is not the table's.
Contender plain_contender(const std::string& name, const GainTable& table);

/// Faster than the joint can ever be: what the motor can do is then the only limit of the reference.
inline constexpr MotionLimits kNoMotionLimits{1e3, 1e6, 1e6};

/// How the daemon would configure its controller for the plant, with its link, spring and gravity; the torque limit is the table's.
JointControllerConfig extended_config(const JointPlantConfig& plant, const GainTable& table,
                                      const MotionLimits& motion = kNoMotionLimits);

/// The plant with the friction that `table` declares at `temperature_C` in the place of its own: what is left to be wrong is not friction.
JointPlantConfig with_declared_friction(JointPlantConfig plant, const GainTable& table, double temperature_C);

/// The daemon's controller with `table`. Where the plant has no torque limit neither has the controller.
Contender extended_contender(const std::string& name, const GainTable& table,
                             const MotionLimits& motion = kNoMotionLimits,
                             Mechanism without = Mechanism::kNone);

Contender pid_contender();

/// Runs the daemon's joint controller in the simulated loop; as in the daemon, a joint that oscillates is
/// switched off. torque_Nm() is real-time safe.
class ExtendedLoopController final : public LoopController {
 public:
  ExtendedLoopController(const JointControllerConfig& config, const GainTable& table) noexcept;
  double torque_Nm(const LoopSample& sample) noexcept override;
  void reset() noexcept override;
  bool switched_off() const noexcept override { return off_; }

 private:
  JointControllerConfig config_;
  GainTable table_;
  JointController controller_;
  bool off_ = false;
  bool started_ = false;
};

struct Chapter6Tables {
  std::vector<GainTable> source;  ///< C1..C4, designed as in Zhao (2006): by forward Euler, from its rules
  GainTable shipped;              ///< what a daemon runs: certified as sampled and held, from the catalogue
};

/// c1.json .. c4.json and rhs17-6006.json of `directory`. Throws InputError.
Chapter6Tables read_chapter6_tables(const std::filesystem::path& directory);

/// PID and C1..C4 of Zhao (2006), and "C4+": the shipped table in the daemon's controller.
std::vector<Contender> chapter6_contenders(const Chapter6Tables& tables);

}  // namespace strainwave
