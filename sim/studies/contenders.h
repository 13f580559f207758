// SPDX-License-Identifier: BSD-3-Clause
// The contenders of a comparison: the PID of Zhao (2006), the plain table controllers C1..C4, and C4 as the
// daemon runs it. Offline.
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

/// A named factory that makes a controller for a plant.
struct Contender {
  std::string name;
  std::function<std::unique_ptr<LoopController>(const JointPlantConfig&)> make;
};

/// The primary gains of `table` (C1..C4) in the bare control law of control/scheduled_controller.h. Setpoints are
/// steps, and the plant's peak torque is the limit. Throws InputError if a run's period is not the table's.
Contender plain_contender(const std::string& name, const GainTable& table);

/// Limits beyond any joint, so that only the motor limits the reference.
inline constexpr MotionLimits kNoMotionLimits{1e3, 1e6, 1e6};

/// The daemon's configuration of its controller for the plant, with its link, spring and gravity. The torque limit is the table's.
JointControllerConfig extended_config(const JointPlantConfig& plant, const GainTable& table,
                                      const MotionLimits& motion = kNoMotionLimits);

/// The plant with the friction that `table` declares at `temperature_C`, so that the controller's friction model has no error.
JointPlantConfig with_declared_friction(JointPlantConfig plant, const GainTable& table, double temperature_C);

/// The daemon's controller with `table`. If the plant has no torque limit, the controller has none either.
Contender extended_contender(const std::string& name, const GainTable& table,
                             const MotionLimits& motion = kNoMotionLimits,
                             Mechanism without = Mechanism::kNone);

Contender pid_contender();

/// Runs the daemon's joint controller in the simulated loop. As in the daemon, a joint that oscillates is
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
  std::vector<GainTable> source;  ///< C1..C4, designed by forward Euler from the rules of Zhao (2006)
  GainTable shipped;              ///< the daemon's table, certified as sampled and held; catalogue friction
};

/// Reads c1.json .. c4.json and rhs17-6006.json from `directory`. Throws InputError.
Chapter6Tables read_chapter6_tables(const std::filesystem::path& directory);

/// PID and C1..C4 of Zhao (2006), and "C4+": the shipped table in the daemon's controller.
std::vector<Contender> chapter6_contenders(const Chapter6Tables& tables);

}  // namespace strainwave
