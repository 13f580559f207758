// Position, velocity and disturbance from a coarse encoder: a Kalman filter that knows the torque and the
// friction, stiction included. Real-time safe.
//
// An encoder reads intervals, not positions. What a reading adds is which of its two edges has been passed,
// or not yet been reached, since the last one; the estimate is conditioned on exactly that (a Gaussian
// truncated at the edge). So a count change tells the position to within what the joint moves in a period,
// and a joint at rest learns nothing from the same reading again. In a stream and on a path, where
// the position is known no better than a new count tells it, both edges of that are news. The estimate is quiet: at rest, with less
// torque than friction holds, velocity is exactly zero. Source: assumed-density filtering, Maybeck,
// "Stochastic Models, Estimation and Control" vol. 2 (1982), chapter 12. It knows one mass: what the motions of a joint with a spring
// show of its inertia, inertia_estimate.h tells.
#pragma once

#include <Eigen/Core>

#include "control/joint_model.h"

namespace strainwave {

struct VelocityObserverConfig {
  double period_s = 0.001;              ///< > 0
  double encoder_resolution_rad = 0.0;  ///< position of one count; 0: exact
  double edge_deviation_counts = 0.02;  ///< how evenly the encoder's edges lie
  double sampling_deviation_s = 0.0;    ///< >= 0: of the instants at which positions are sampled
};

/// The estimate at a sample.
struct JointEstimate {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< exactly 0 at rest
  JointDisturbance disturbance;
  double inertia_ratio = 1.0;           ///< the joint's inertia in units of the model's
  double position_deviation_rad = 0.0;  ///< standard deviation of the position
  double friction_deviation_Nm = 0.0;   ///< the same of friction and load together
  bool surprised = false;               ///< this reading contradicted what the model foresaw
};

/// What a reading that contradicts the model is first taken for, by what the joint was doing.
enum class SurpriseCause {
  kLoad,      ///< a joint that rests, or is pushed towards its last counts: something else pushed it
  kFriction,  ///< a planned motion: as far as a count goes, friction that is not the model's, as it never quite is while a joint breaks away
  /// The same where the motion is a stream's or a path's, which may turn anywhere.
  kFollowedFriction,
};

class VelocityObserver {
 public:
  explicit VelocityObserver(const VelocityObserverConfig& config) noexcept : config_(config) {
    reset(0.0, 0.0);
  }

  /// Where the encoder reads `position_rad`, at `velocity_rad_s` (0: at rest) as two readings tell it, and
  /// with `load_Nm`; friction and load unknown again, in units of `friction_scale_Nm` (joint_model.h).
  void reset(double position_rad, double friction_scale_Nm, double velocity_rad_s = 0.0,
             double load_Nm = 0.0) noexcept;
  /// The period that ends now: the torque that acted over it, by a joint like `model`, and what the joint was doing: in a stream and on a path
  /// (kFollowedFriction) friction's error is taken to go with the speed, and what seems to stand may yet be moving.
  void predict(double torque_Nm, const JointModel& model,
               SurpriseCause cause = SurpriseCause::kLoad) noexcept;
  /// The encoder's reading now.
  void correct(double position_rad, SurpriseCause cause = SurpriseCause::kLoad) noexcept;
  /// Exact position and velocity, for joints that have them.
  void correct_exactly(double position_rad, double velocity_rad_s) noexcept;

  JointEstimate estimate() const noexcept;

 private:
  double inertia_ratio() const noexcept;
  /// So many deviations outside of its edges, the model did not foresee a reading.
  static constexpr double kSurprise = 4.0;
  enum : int { kPosition = 0, kVelocity = 1, kFriction = 2, kLoad = 3, kInertia = 4 };
  using State = Eigen::Matrix<double, 5, 1>;  // position, velocity, friction offset, load, inertia ratio - 1
  using Covariance = Eigen::Matrix<double, 5, 5>;

  void doubt_rest(double torque_Nm, const JointModel& model) noexcept;
  void drift(double end_velocity_rad_s, const JointModel& model, bool followed) noexcept;
  void doubt_direction(const ModelMotion& motion, double start_deviation, const JointModel& model) noexcept;
  double reading_variance() const noexcept;
  void truncate(double edge_rad, double side, SurpriseCause cause) noexcept;
  void weigh(double position_rad, SurpriseCause cause) noexcept;
  void admit_surprise(double distance_rad, SurpriseCause cause) noexcept;
  void bound_parameters() noexcept;
  void add_covariance(int a, int b, double value) noexcept;
  void condition(int component, double shift, double variance_ratio) noexcept;

  VelocityObserverConfig config_;
  State state_ = State::Zero();
  Covariance covariance_ = Covariance::Zero();
  double reading_rad_ = 0.0;
  double moved_rad_ = 0.0;  ///< predicted since that reading
  int periods_ = 0;         ///< the same
  double inertia_kgm2_ = 1.0;
  double static_friction_Nm_ = 0.0;  ///< of the last model
  bool surprised_ = false;           ///< by the last reading
};

}  // namespace strainwave
