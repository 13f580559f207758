// The inertia that a joint's motions show, of motor and link together, whatever hangs on it: what the torque was over a while against
// how the velocity changed. Real-time safe. Joint side, SI.
//
//   J (w(t) - w(t - T)) = I(t) - I(t - T) - k (R(t) - R(t - T)) - c T
//   I = integral of (torque - load as it is told),   R = integral of the table's friction, with the sign of the motion
//
// J, k (how much of the table's friction there is) and c (a load that nobody tells) are fitted by least squares over windows of T, what
// lies back counting less. Of w, I and R the means over 4 ms are taken, which makes the velocity of so many counts one, and the
// equation stays exact. T is 20 ms, about a swing of the gear's spring (catalogue: 12 to 36 ms), so that motor and link count as one. Only windows in which the joint
// moves one way all the time tell anything: stiction balances whatever there is. At first k is 1 and c is 0, as far as friction is known;
// what the configuration says of J is not used.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "control/joint/joint_measurement.h"
#include "control/joint/joint_model.h"

namespace strainwave {

struct InertiaEstimateConfig {
  double period_s = 0.001;              ///< > 0
  double encoder_resolution_rad = 0.0;  ///< >= 0
  int delay_periods = 0;                ///< between a torque's command and its effect, 0..kMaxControlDelay
};

class InertiaEstimate {
 public:
  /// What a period ended with.
  struct Sample {
    double position_rad = 0.0;
    /// Commanded when the period began, after all limits, and what of it the load that is told takes: both take effect when the
    /// delay is over.
    double torque_Nm = 0.0;
    double told_load_Nm = 0.0;
  };

  explicit InertiaEstimate(const InertiaEstimateConfig& config) noexcept;

  /// The next period's; `model` says what friction there is by the table, and its scale. Where a reading is missing or a period was
  /// left out interrupt() is called in its place.
  void step(const Sample& sample, const JointModel& model) noexcept;
  void interrupt() noexcept { samples_ = moving_ = 0; }
  /// Another load, perhaps: what was learned is forgotten.
  void forget() noexcept;

  /// kg m2, while its standard deviation is at most kKnown of it.
  std::optional<double> inertia_kgm2() const noexcept;
  /// What the estimate may be off by, standard deviation; meaningless before windows were seen.
  double deviation_kgm2() const noexcept { return deviation_kgm2_; }

  static constexpr double kKnown = 0.1;

 private:
  static constexpr unsigned kRoom =
      512U;  ///< a power of two, above the longest span and window, and kMaxControlDelay

  struct Sums {
    double position_rad = 0.0;
    double impulse_Nms = 0.0;   ///< I
    double friction_Nms = 0.0;  ///< R
  };
  /// Means over a span.
  struct Means {
    double velocity_rad_s = 0.0;
    double impulse_Nms = 0.0;
    double friction_Nms = 0.0;
  };
  const Sums& sums(int periods_ago) const noexcept;
  Means means(int periods_ago) const noexcept;
  void learn(double friction_scale_Nm) noexcept;

  InertiaEstimateConfig config_;
  int span_;                               ///< periods of a mean
  int window_;                             ///< T, periods
  std::array<double, kRoom> torque_Nm_{};  ///< commanded, less the load
  std::array<Sums, kRoom> sums_{};
  unsigned now_ = 0;
  int samples_ = 0;  ///< without a gap
  int moving_ = 0;   ///< of these, the last ones in which the joint moved, all one way
  int way_ = 0;
  // Normal equations of [J, k, c], and the squares of what the solution leaves, each window in units of its noise.
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  double squares_ = 0.0;
  double windows_ = 0.0;
  double inertia_kgm2_ = 0.0;
  double deviation_kgm2_ = 0.0;
};

}  // namespace strainwave
