// SPDX-License-Identifier: BSD-3-Clause
// Moves a joint of which little is known so that its trace shows what it is: stepped once a period, it takes a reading and returns an
// order. Slow ramps find the torque of breaking away and its sign. Strokes at steady speeds show friction. Strokes with a sum of sines on
// the torque show inertias and spring, around a steady motion, where stiction has no part. Joint side, SI. Not real-time.
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

/// What of the motion is made.
enum class ExcitationPart {
  kAll,
  kRamps,          ///< torque of breaking away
  kSteadyStrokes,  ///< friction
  kShakenStrokes,  ///< inertias and spring
};

struct ExcitationConfig {
  ExcitationPart part = ExcitationPart::kAll;
  ExcitationLimits limits;
  double period_s = 0.001;
  double encoder_resolution_rad = 0.0;
  double gear_ratio = 0.0;
  double motor_inertia_kgm2 = 0.0;  ///< within a factor of three
  double start_rad = 0.0;           ///< where the joint rests without torque; it comes back to it
  double longest_s = 180.0;         ///< it ends then; room for the trace is taken before
};

/// A stretch at one speed.
struct Stroke {
  double to_rad = 0.0;
  double speed_rad_s = 0.0;  ///< > 0
  bool shaken = false;       ///< with the sum of sines
};

/// Strokes of a range and part: steady speeds there and back, slow ones first, then shaken ones. Throws InputError where the range or the speed
/// limit is too small for them, naming what is wanted.
std::vector<Stroke> plan_strokes(const ExcitationConfig& config);

class Excitation {
 public:
  enum class Stage { kEnabling, kBreakingAway, kStroking, kReturning, kBraking, kDone };

  /// Throws InputError.
  explicit Excitation(const ExcitationConfig& config);

  /// One period. It allocates nothing unless it ends early.
  ActuatorCommand step(const ActuatorReading& reading);

  bool ended() const { return stage_ == Stage::kDone; }
  /// Why it ended early; empty: it did not.
  const std::string& problem() const { return problem_; }
  Stage stage() const { return stage_; }
  /// Brakes and ends, as where a limit is passed.
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
  std::size_t done_ = 0;             ///< ramps or strokes
  long stage_periods_ = 0;           ///< since the ramp, stroke or stage began
  double quick_rad_s_ = 0.0;         ///< over few periods, for what must be seen soon
  double planned_rad_s_ = 0.0;       ///< speed that is followed
  double braked_from_rad_s_ = 0.0;   ///< its size when braking began
  double inertia_kgm2_;              ///< of motor and link
  std::array<double, 2> hold_Nm_{};  ///< integral of the speed's error, by direction: friction and load
  double sticking_Nm_ = 0.0;         ///< against stiction
  SineSum sines_;
  double shake_rms_Nm_;
  double shake_squares_ = 0.0;  ///< of the speed around the stroke's
  long shaken_periods_ = 0;
};

}  // namespace strainwave
