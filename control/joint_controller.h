// Everything that one joint needs each period, in one object that the daemon and the simulator both run:
// gains chosen by the state of the temperature signal, velocity estimate, reference shaping, control law.
// Real-time safe, load() included: nothing allocates, throws, locks or reads a clock. Joint side, SI.
//
//   measurement -> gains in use -> velocity -> reference -> feedback + feed-forward -> saturate -> torque
#pragma once

#include "control/gain_table.h"
#include "control/reference_shaper.h"
#include "control/scheduled_controller.h"

namespace strainwave {

/// The motor's limits as a line over speed: |Tm| <= min(peak, stall - slope * velocity along the torque), see
/// data/rhs17_datasheet.csv. Infinite where unknown.
struct MotorLimits {
  double peak_torque_Nm = 0.0;            ///< > 0
  double stall_torque_Nm = 0.0;           ///< Kt V / R > 0
  double torque_per_speed_Nms_rad = 0.0;  ///< Kt Ke / R >= 0, Ke in V.s/rad
};

/// One joint's configuration. Each feature can be switched off, which leaves the plain control law of the
/// table.
struct JointControllerConfig {
  double period_s = 0.001;              ///< > 0, the table's
  double encoder_resolution_rad = 0.0;  ///< position of one count at the joint; 0: exact
  int delay_samples = 0;                ///< periods between a torque's computation and its effect, 0 or 1
  double torque_limit_Nm = 0.0;         ///< > 0; the table's limit applies as well
  MotorLimits motor;
  MotionLimits motion;       ///< never exceeded by the reference; what the joint can do limits it further
  bool use_observer = true;  ///< velocity from the encoder by a model, else by difference
  bool use_shaping = true;   ///< else targets are steps
  bool use_rest = true;      ///< quiet torque and integrator inside one count of the target
};

/// One period's measurements.
struct JointMeasurement {
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;  ///< used only when has_velocity
  double torque_applied_Nm = 0.0;     ///< what acted during the period that ends now
  double temperature_C = 0.0;         ///< used only when temperature_valid
  bool has_velocity = false;
  bool temperature_valid = false;
};

enum class GainsInUse : int { kNone = 0, kPrimary = 1, kFallback = 2 };

/// One period's result.
struct JointStep {
  ControllerOutput output;
  Reference reference;                ///< what the joint tracks now
  double joint_velocity_rad_s = 0.0;  ///< measured or estimated, as the feedback used it
  GainsInUse gains_in_use = GainsInUse::kNone;
  bool at_target = false;  ///< the reference has ended on the target
};

class JointController {
 public:
  explicit JointController(const JointControllerConfig& config) noexcept;

  /// Takes `table`, which must be certified for this joint and period. While running the change makes no
  /// torque step: the integral is chosen so that the torque stays what it was.
  void load(const GainTable& table) noexcept;
  bool has_table() const noexcept { return has_table_; }

  /// Begins to hold `position_rad` with nothing remembered: call when the drive becomes enabled.
  void start(double position_rad) noexcept;
  /// Moves there, from now on.
  void set_target(double position_rad) noexcept { shaper_.set_target(position_rad); }
  /// Decelerates to rest and holds.
  void stop() noexcept { shaper_.stop(); }
  /// Where the motion ends.
  double target_rad() const noexcept { return shaper_.target_rad(); }

  /// One period. Needs a table and start(); without a table the torque is 0.
  JointStep step(const JointMeasurement& measurement) noexcept;

  /// Weights of the temperature rules in use.
  const TemperatureWeights& temperature_weights() const noexcept { return primary_.temperature_weights(); }

 private:
  void choose_gains(const JointMeasurement& measurement) noexcept;
  double estimate_velocity(const JointMeasurement& measurement) noexcept;
  Reference next_reference() noexcept;
  ScheduledController& active() noexcept {
    return gains_in_use_ == GainsInUse::kFallback ? fallback_ : primary_;
  }

  JointControllerConfig config_;
  ReferenceShaper shaper_;
  ScheduledController primary_;
  ScheduledController fallback_;
  GainsInUse gains_in_use_ = GainsInUse::kNone;
  double table_torque_limit_Nm_ = 0.0;
  double scheduled_temperature_C_ = 0.0;
  double previous_position_rad_ = 0.0;
  double previous_torque_Nm_ = 0.0;
  bool has_table_ = false;
  bool has_temperature_ = false;
  bool carry_over_ = false;  ///< the gains have changed: continue from the previous torque
};

}  // namespace strainwave
