// SPDX-License-Identifier: BSD-3-Clause
// Moves a little-known joint so that its trace shows its parameters. Once a period, step() takes a reading and returns a command. Slow
// ramps find the breakaway torque and its sign. Strokes at steady speeds show friction. Strokes with a sum of sines on the torque show
// inertias and spring around a steady motion, without stiction. Joint side, SI. Not real-time.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "commission/joint_trace.h"
#include "commission/motion_guard.h"
#include "commission/sine_sum.h"
#include "drivers/actuator.h"

namespace strainwave {

/// Which part of the motion runs.
enum class ExcitationPart {
  kAll,
  kRamps,          ///< breakaway torque
  kSteadyStrokes,  ///< friction
  kShakenStrokes,  ///< inertias and spring
};

struct ExcitationConfig {
  ExcitationPart part = ExcitationPart::kAll;
  ExcitationLimits limits;
  double period_s = 0.001;
  double encoder_resolution_rad = 0.0;
  double gear_ratio = 0.0;
  double motor_inertia_kgm2 = 0.0;  ///< right to a factor of three
  double start_rad = 0.0;           ///< where the joint rests without torque, and returns at the end
  double longest_s = 180.0;         ///< time limit; the trace is allocated for it
};

/// A motion at one speed.
struct Stroke {
  double to_rad = 0.0;
  double speed_rad_s = 0.0;  ///< > 0
  bool shaken = false;       ///< with the sum of sines
};

/// Plans the strokes of a part: two slow shaken ones, steady speeds there and back from slow to fast, then shaken ones. Throws InputError
/// with the requirement if start, range, speed limit or acceleration does not allow them.
std::vector<Stroke> plan_strokes(const ExcitationConfig& config);

class Excitation {
 public:
  enum class Stage { kEnabling, kBreakingAway, kStroking, kReturning, kBraking, kDone };

  /// Throws InputError.
  explicit Excitation(const ExcitationConfig& config);

  /// Runs one period. Allocates nothing unless the motion ends early.
  ActuatorCommand step(const ActuatorReading& reading);

  bool ended() const { return stage_ == Stage::kDone; }
  /// Why the motion ended early; empty if it did not.
  const std::string& problem() const { return problem_; }
  Stage stage() const { return stage_; }
  /// Brakes and ends the motion, as after a violated limit.
  void abort(const std::string& why);

  const JointTrace& trace() const { return trace_; }

 private:
  double torque_Nm(double position_rad, double speed_rad_s);
  void begin_braking();
  bool runs_away() const;
  double ramp_Nm(double position_rad);
  double stroke_Nm(double position_rad, double speed_rad_s);
  double follow_Nm(double speed_rad_s, double acceleration_rad_s2);
  double shake_Nm(double position_rad);
  void adapt_shaking();
  void next_stroke();
  void record(const ActuatorReading& reading, double torque_Nm);

  ExcitationConfig config_;
  MotionGuard guard_;
  MeanSpeed quick_speed_;
  MeanSpeed mean_speed_;
  std::vector<Stroke> strokes_;
  JointTrace trace_;
  std::string problem_;
  Stage stage_ = Stage::kEnabling;
  std::size_t done_ = 0;             ///< completed ramps or strokes
  long stage_periods_ = 0;           ///< since the ramp, stroke or stage began
  double quick_rad_s_ = 0.0;         ///< mean over few periods, for fast reactions
  double planned_rad_s_ = 0.0;       ///< speed setpoint
  double braked_from_rad_s_ = 0.0;   ///< absolute speed when braking began
  double inertia_kgm2_;              ///< of motor and link
  std::array<double, 2> hold_Nm_{};  ///< integrals of the speed error by direction, for friction and load
  double sticking_Nm_ = 0.0;         ///< additional torque against stiction
  SineSum sines_;
  double shake_rms_Nm_;
  double shake_squares_ = 0.0;  ///< sum of squared speed deviations from the stroke's
  long shaken_periods_ = 0;
};

}  // namespace strainwave
