// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/link_limit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "base/input_error.h"
#include "base/printable.h"
#include "sim/studies/linear_program.h"

namespace strainwave {

namespace {

constexpr int kStates = 4;  // motor position and velocity, link position and velocity
// The computing time grows at least with its square: half a minute for 400 periods, with the settling time.
constexpr int kLongestMotion = 700;
using Matrix = Eigen::Matrix<double, kStates + 2, kStates + 2>;

/// exp(A): Taylor series of a scaled matrix, squared back.
Matrix exponential(const Matrix& a) {
  const int squarings = std::max(0, static_cast<int>(std::ceil(std::log2(std::max(1e-300, a.norm())))) + 4);
  const Matrix scaled = a * std::ldexp(1.0, -squarings);
  Matrix sum = Matrix::Identity();
  Matrix term = Matrix::Identity();
  for (int i = 1; i <= 16; ++i) {
    term = term * scaled / i;
    sum += term;
  }
  for (int i = 0; i < squarings; ++i) sum = sum * sum;
  return sum;
}

/// One period under constant torque: x+ = A x + b u + c. The last two columns are b and c; c is Coulomb friction and load.
Matrix sampled(const LinkLimitConfig& c, double direction) {
  Matrix a = Matrix::Zero();
  a(0, 1) = a(2, 3) = 1.0;
  a.block<1, 4>(1, 0) << -c.stiffness_Nm_rad, -c.damping_Nms_rad - c.friction.viscous_Nms_rad,
      c.stiffness_Nm_rad, c.damping_Nms_rad;
  a(1, 4) = 1.0;
  a(1, 5) = -c.friction.coulomb_Nm;
  a.row(1) /= c.motor_inertia_kgm2;
  a.block<1, 4>(3, 0) << c.stiffness_Nm_rad, c.damping_Nms_rad, -c.stiffness_Nm_rad,
      -c.damping_Nms_rad - c.link_viscous_Nms_rad;
  a(3, 5) = -direction * c.load_torque_Nm;
  a.row(3) /= c.link_inertia_kgm2;
  return exponential(a * c.period_s);
}

/// The programme over `periods` periods of motion, in units of the step and of the peak torque. With `band_rad` the
/// error is only bounded, from sample `settled` on. Otherwise the sum of the error is the cost.
class Programme {
 public:
  Programme(const LinkLimitConfig& config, int periods, std::optional<double> band_rad = {}, int settled = 0)
      : config_(config),
        step_rad_(std::abs(config.step_rad)),
        direction_(config.step_rad < 0.0 ? -1.0 : 1.0) {
    scale_ << step_rad_, step_rad_ / (10.0 * config.period_s), step_rad_,
        step_rad_ / (10.0 * config.period_s);
    const Matrix plant = sampled(config, direction_);
    std::array<int, kStates> before{};
    for (int k = 0; k < periods; ++k) {
      const int torque = program_.add_unknown(-1.0, 1.0);
      torques_.push_back(torque);
      std::array<int, kStates> after = add_states();
      add_dynamics(plant, k == 0 ? nullptr : &before, after, torque);
      if (std::isfinite(config.motor.stall_torque_Nm) && k > 0) add_supply(torque, before[1]);
      add_error(after[2], band_rad, k + 1 >= settled, k + 1 == periods);
      links_.push_back(after[2]);
      before = after;
    }
    // The motion ends at rest, with the spring carrying only the load.
    add_equal(before[0], before[2], config.load_torque_Nm * direction_ / config.stiffness_Nm_rad / step_rad_);
    add_equal(before[1], before[3], 0.0);
    const int rest = program_.add_row(0.0, 0.0);
    program_.set(rest, before[1], 1.0);
  }

  LinearProgram::Solution solve() const { return program_.solve(); }
  const std::vector<int>& torques() const { return torques_; }
  const std::vector<int>& links() const { return links_; }

 private:
  std::array<int, kStates> add_states() {
    std::array<int, kStates> states{};
    for (int i = 0; i < kStates; ++i)  // the motor turns one way
      states[static_cast<std::size_t>(i)] =
          program_.add_unknown(i == 1 ? 0.0 : -LinearProgram::kFree, LinearProgram::kFree);
    return states;
  }
  void add_dynamics(const Matrix& plant, const std::array<int, kStates>* before,
                    const std::array<int, kStates>& after, int torque) {
    for (int i = 0; i < kStates; ++i) {
      double constant = plant(i, 5);
      // Before the motion the spring carries the load.
      if (before == nullptr)
        constant -= plant(i, 2) * direction_ * config_.load_torque_Nm / config_.stiffness_Nm_rad;
      const int row = program_.add_row(constant / scale_(i), constant / scale_(i));
      program_.set(row, after[static_cast<std::size_t>(i)], 1.0);
      program_.set(row, torque, -plant(i, 4) * config_.motor.peak_torque_Nm / scale_(i));
      if (before == nullptr) continue;
      for (int j = 0; j < kStates; ++j)
        program_.set(row, (*before)[static_cast<std::size_t>(j)], -plant(i, j) * scale_(j) / scale_(i));
    }
  }
  void add_supply(int torque, int velocity) {
    const MotorLimits& motor = config_.motor;
    const int row = program_.add_row(-LinearProgram::kFree, motor.stall_torque_Nm / motor.peak_torque_Nm);
    program_.set(row, torque, 1.0);
    program_.set(row, velocity, motor.torque_per_speed_Nms_rad * scale_(1) / motor.peak_torque_Nm);
  }
  void add_error(int link, std::optional<double> band_rad, bool settled, bool last) {
    if (band_rad) {
      if (!settled) return;
      const int row = program_.add_row(1.0 - *band_rad / step_rad_, 1.0 + *band_rad / step_rad_);
      program_.set(row, link, 1.0);
      return;
    }
    const int error = program_.add_unknown(0.0, last ? 0.0 : LinearProgram::kFree, 1.0);
    const int above = program_.add_row(1.0, LinearProgram::kFree);  // error >= 1 - link
    program_.set(above, error, 1.0);
    program_.set(above, link, 1.0);
    const int below = program_.add_row(-1.0, LinearProgram::kFree);  // error >= link - 1
    program_.set(below, error, 1.0);
    program_.set(below, link, -1.0);
  }
  void add_equal(int a, int b, double difference) {
    const int row = program_.add_row(difference, difference);
    program_.set(row, a, 1.0);
    program_.set(row, b, -1.0);
  }

  const LinkLimitConfig& config_;
  double step_rad_;
  double direction_;
  Eigen::Vector4d scale_;
  LinearProgram program_;
  std::vector<int> torques_, links_;
};

/// The speed at which friction, supply and load take all of the motor's torque; infinite if none of them grows with speed.
double top_speed_rad_s(const LinkLimitConfig& c) {
  const double viscous_Nms_rad = c.friction.viscous_Nms_rad + c.link_viscous_Nms_rad;
  const double steady_Nm = c.friction.coulomb_Nm + std::abs(c.load_torque_Nm);
  return std::min(
      (c.motor.peak_torque_Nm - steady_Nm) / viscous_Nms_rad,
      (c.motor.stall_torque_Nm - steady_Nm) / (c.motor.torque_per_speed_Nms_rad + viscous_Nms_rad));
}

void require_motion(const LinkLimitConfig& c) {
  if (!std::isfinite(c.motor.peak_torque_Nm))
    throw InputError("flexible limit", "peak_torque_Nm", "infinite",
                     "must be finite: otherwise a move would take no time");
  if (!(c.motor.peak_torque_Nm > c.friction.static_Nm + std::abs(c.load_torque_Nm)))
    throw InputError("flexible limit", "peak_torque_Nm", number_text(c.motor.peak_torque_Nm),
                     "must exceed static friction and load, or the joint cannot move");
  if (!(std::isfinite(c.step_rad) && c.step_rad != 0.0))
    throw InputError("flexible limit", "step_rad", number_text(c.step_rad), "must be finite and not 0");
  const double farthest_rad = top_speed_rad_s(c) * kLongestMotion * c.period_s;
  if (std::abs(c.step_rad) > farthest_rad)
    throw InputError("flexible limit", "step_rad", number_text(c.step_rad),
                     "must be below " + number_text(farthest_rad) + ", the way at top speed in the " +
                         std::to_string(kLongestMotion) + " periods that the solver allows");
}

/// First estimate of the number of periods: bang-bang of the total inertia with the torque that friction
/// leaves, and one swing of the spring. At high speed the supply's line decides.
int first_guess(const LinkLimitConfig& c) {
  const double inertia = c.motor_inertia_kgm2 + c.link_inertia_kgm2;
  const double acceleration =
      (c.motor.peak_torque_Nm - c.friction.coulomb_Nm - std::abs(c.load_torque_Nm)) / inertia;
  const double swing_s =
      2.0 * std::numbers::pi /
      free_free_frequency_rad_s(c.motor_inertia_kgm2, c.link_inertia_kgm2, c.stiffness_Nm_rad);
  const double duration_s = std::max(2.0 * std::sqrt(std::abs(c.step_rad) / acceleration),
                                     std::abs(c.step_rad) / top_speed_rad_s(c)) +
                            swing_s;
  return 5 + static_cast<int>(std::ceil(duration_s / c.period_s));
}

}  // namespace

LinkLimitConfig link_limit_config(const JointPlantConfig& plant, double temperature_C, double step_rad,
                                  double load_torque_Nm) {
  if (!plant.effects.transmission)
    throw InputError("flexible limit", "link", "none", "a plant with a link is needed");
  const Transmission& gear = *plant.effects.transmission;
  LinkLimitConfig config;
  config.motor_inertia_kgm2 = plant.joint.inertia_kgm2;
  config.link_inertia_kgm2 = gear.link_inertia_kgm2;
  const double transmitted_Nm = plant.motor.peak_torque_Nm * gear.link_inertia_kgm2 /
                                (gear.link_inertia_kgm2 + plant.joint.inertia_kgm2);
  if (std::isfinite(transmitted_Nm)) config.stiffness_Nm_rad = gear.spring.secant_Nm_rad(transmitted_Nm);
  config.damping_Nms_rad = gear.damping_Nms_rad;
  config.link_viscous_Nms_rad = gear.link_viscous_Nms_rad;
  config.friction = plant.joint.friction.at(temperature_C);
  config.motor = plant.motor;
  config.load_torque_Nm = load_torque_Nm;
  config.period_s = plant.period_s;
  config.delay_periods = static_cast<int>(std::floor(plant.delay.periods));
  config.step_rad = step_rad;
  require_motion(config);
  return config;
}

LinkLimit find_link_limit(const LinkLimitConfig& config) {
  require_motion(config);
  for (int periods = std::min(first_guess(config), kLongestMotion);;
       periods = std::min(periods * 3 / 2 + 1, kLongestMotion)) {
    const Programme programme(config, periods);
    const LinearProgram::Solution solution = programme.solve();
    if (!solution.optimal && periods < kLongestMotion) continue;
    if (!solution.optimal) break;
    LinkLimit limit;
    limit.link_position_rad.assign(static_cast<std::size_t>(config.delay_periods) + 1, 0.0);
    limit.torque_Nm.assign(static_cast<std::size_t>(config.delay_periods), 0.0);
    for (const int link : programme.links())
      limit.link_position_rad.push_back(std::abs(config.step_rad) *
                                        solution.unknowns[static_cast<std::size_t>(link)]);
    for (const int torque : programme.torques())
      limit.torque_Nm.push_back(config.motor.peak_torque_Nm *
                                solution.unknowns[static_cast<std::size_t>(torque)]);
    for (double& position_rad : limit.link_position_rad) {
      const double error_rad = std::abs(std::abs(config.step_rad) - position_rad);
      limit.pi2 += error_rad / std::abs(config.step_rad);
      if (error_rad > kCountedError_rad) limit.counted_pi2 += error_rad / std::abs(config.step_rad);
      position_rad = std::copysign(position_rad, config.step_rad * position_rad);
    }
    return limit;
  }
  throw InputError("flexible limit", "step_rad", number_text(config.step_rad),
                   "must be less: no motion of " + std::to_string(kLongestMotion) + " periods reaches it");
}

double least_settling_time_s(const LinkLimitConfig& config, double band_rad) {
  require_motion(config);
  const int longest = static_cast<int>(find_link_limit(config).torque_Nm.size()) - config.delay_periods;
  int low = 0;
  int high = longest;
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (Programme(config, longest, band_rad, middle).solve().optimal ? high : low) = middle;
  }
  return config.period_s * (high + config.delay_periods);
}

}  // namespace strainwave
