// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/table_reach.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "control/joint/link_velocity.h"
#include "control/table/box_certificate.h"

namespace strainwave {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The sum of an impulse response ends when a batch of samples adds less than this share.
constexpr int kBatch = 1000;
constexpr double kSmallestShare = 1e-6;
constexpr int kMostBatches = 1000;
// Steps of s, in units of B' P B / 2, which s must exceed. A step is a sixth of a decade.
constexpr int kSteps = 36;
constexpr int kStepsPerDecade = 6;
constexpr int kHalvings = 40;

// Fixed-size storage keeps the long loops below free of heap allocation.
using States = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxProofStates, 1>;
using Inputs = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::ColMajor, kMaxProofStates, 2>;

// Indices of the plant's first state (the position) and of the last reading.
Eigen::Index position_of(const SpringLoop& loop) {
  return loop.has_integrator ? 1 : 0;
}
Eigen::Index last_reading_of(const SpringLoop& loop) {
  return position_of(loop) + loop.plant_states;
}

// The row y of spring_plant.h.
Eigen::RowVectorXd reading(const SpringLoop& loop) {
  Eigen::RowVectorXd y = Eigen::RowVectorXd::Zero(loop.states());
  y(position_of(loop)) = 1.0;
  if (loop.encoder_side == EncoderSide::kLink && loop.plant_states == kSpringPlantStates)
    y(position_of(loop) + 2) = 1.0;
  return y;
}

// [A B; 0 1], where B is that of a torque at the link, or at the motor of a rigid joint.
ProofMatrix sampled_with_load(const SpringPlant& plant, double period_s) {
  BoundedMatrix generator = spring_generator(plant, period_s);
  if (plant.link_inertia_kgm2 == 0.0) return spring_exponential(generator).value;
  for (const Eigen::Index row : {1, 3}) generator.set(row, kSpringPlantStates, 0.0);
  generator.set(3, kSpringPlantStates, Bounded(period_s) / plant.link_inertia_kgm2);
  return spring_exponential(generator).value;
}

// The sum of |y H^k b| for each column b of `inputs`.
Eigen::RowVector2d sums_of_response(const ProofMatrix& H, Inputs inputs, const Eigen::RowVectorXd& y) {
  Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
  for (int batch = 0; batch < kMostBatches; ++batch) {
    const Eigen::RowVector2d before = sum;
    for (int k = 0; k < kBatch; ++k) {
      sum += y.lazyProduct(inputs).cwiseAbs();
      inputs = H.lazyProduct(inputs).eval();
    }
    if (((sum - before).array() <= kSmallestShare * sum.array()).all()) return sum;
  }
  return Eigen::RowVector2d::Constant(kInfinity);
}

// The row K of the torque K x that the law demands.
Eigen::RowVectorXd wanted_torque(const BoundedMatrix& sampled, const GainRow& gain, SpringLoop loop) {
  const Eigen::Index n = loop.states();
  const bool at_once = loop.delay_periods == 0;
  if (at_once) loop.delay_periods = 1;
  const ProofMatrix H = spring_loop(sampled, gain, loop).value;
  const Eigen::Index torque = last_reading_of(loop) + 1;
  Eigen::RowVectorXd K = H.row(torque).head(n);
  if (at_once && n > torque) K(n - 1) = H(torque, n);
  return K;
}

// One gain at one corner under limited torque, in coordinates z in which P is the identity and R is diagonal.
class LimitedLoop {
 public:
  LimitedLoop(const Eigen::MatrixXd& H, const Eigen::RowVectorXd& K, const Eigen::VectorXd& B,
              const Eigen::MatrixXd& P) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(P - H.transpose() * P * H, P);
    fall_ = solver.eigenvalues().array();
    wanted_ = (K * solver.eigenvectors()).transpose().array();
    coupling_ = (B.transpose() * P * H * solver.eigenvectors()).transpose().array();
    by_input_ = B.dot(P * B);
  }

  bool proved() const { return fall_.minCoeff() > 0.0; }
  double by_input() const { return by_input_; }

  // The least G P^-1 G' for a given `s` > by_input() / 2. In z, G = a + g / s with a = K - B' P H / s. The
  // best g is -a s / (1 + m s^2 / R), where m >= 0 is the multiplier of the condition on g.
  double least_square(double s) const {
    const States a = wanted_ - coupling_ / s;
    const double allowed = 2.0 * s - by_input_;
    const auto best = [&](double m) -> States { return -a * s / (1.0 + m * s * s / fall_); };
    const auto excess = [&](double m) { return (best(m).square() / fall_).sum() > allowed; };
    if (!excess(0.0)) return 0.0;
    double high = 1e-12;
    for (; excess(high); high *= 10.0)
      if (high > 1e60) return kInfinity;
    double low = 0.1 * high;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (excess(middle) ? low : high) = middle;
    }
    return (a + best(high) / s).square().sum();
  }

 private:
  States fall_, wanted_, coupling_;
  double by_input_ = 0.0;
};

// The largest c for a torque of 1 N m at one corner.
double largest_level(const std::vector<LimitedLoop>& loops) {
  double by_input = 0.0;
  for (const LimitedLoop& loop : loops) {
    if (!loop.proved()) return 0.0;
    by_input = std::max(by_input, loop.by_input());
  }
  double least = kInfinity;
  for (int step = 1; step <= kSteps; ++step) {
    const double s = 0.5 * by_input * std::pow(10.0, static_cast<double>(step) / kStepsPerDecade);
    double worst = 0.0;
    for (const LimitedLoop& loop : loops) worst = std::max(worst, loop.least_square(s));
    least = std::min(least, worst);
  }
  return 1.0 / least;
}

}  // namespace

TableReach reach_of(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                    const ProofMatrix& P) {
  const Eigen::Index n = loop.states();
  const Eigen::RowVectorXd y = reading(loop);
  const Eigen::Index first = position_of(loop);
  const Eigen::Index plant = loop.plant_states;
  TableReach reach;
  double level = kInfinity;
  for (const SpringCorner& corner : spring_corners(box, loop.period_s).corners) {
    Inputs inputs = Inputs::Zero(n, 2);
    inputs.col(0).segment(first, plant) = corner.sampled.value.col(plant).head(plant);
    inputs.col(1).segment(first, plant) =
        sampled_with_load(corner.plant, loop.period_s).col(plant).head(plant);
    const Eigen::VectorXd B = loop.delay_periods == 0 ? Eigen::VectorXd(inputs.col(0))
                                                      : Eigen::VectorXd::Unit(n, last_reading_of(loop) + 1);
    std::vector<LimitedLoop> limited;
    for (const GainRow& gain : gains) {
      const Eigen::MatrixXd H = spring_loop(corner.sampled, gain, loop).value;
      const Eigen::RowVector2d sums = sums_of_response(H, inputs, y);
      reach.motor_rad_per_Nm = std::max(reach.motor_rad_per_Nm, sums(0));
      reach.link_rad_per_Nm = std::max(reach.link_rad_per_Nm, sums(1));
      limited.emplace_back(H, wanted_torque(corner.sampled, gain, loop), B, P);
    }
    level = std::min(level, largest_level(limited));
  }
  // At rest, the last reading has the same error. In motion, the law derives the velocity from the last reading.
  Eigen::VectorXd off = Eigen::VectorXd::Zero(n);
  off(first) = off(last_reading_of(loop)) = 1.0;
  Eigen::VectorXd moving = Eigen::VectorXd::Zero(n);
  moving(first + 1) = 1.0;
  moving(last_reading_of(loop)) = -loop.period_s / velocity_share(loop.encoder_side, loop.period_s);
  reach.position_rad_per_Nm = std::sqrt(level / off.dot(P * off));
  reach.velocity_rad_s_per_Nm = std::sqrt(level / moving.dot(P * moving));
  return reach;
}

TableReach reach_of(const GainTable& table) {
  const std::vector<GainRow> gains = gains_of(table);
  TableReach worst;
  worst.position_rad_per_Nm = worst.velocity_rad_s_per_Nm = kInfinity;
  for (int i = 0; i < table.box.cell_count; ++i) {
    const BoxCell& cell = table.box.cells[static_cast<std::size_t>(i)];
    const TableReach reach = reach_of(gains, spring_box(table, cell), loop_of(table, cell.delay_periods),
                                      lyapunov_of(table, cell));
    worst.motor_rad_per_Nm = std::max(worst.motor_rad_per_Nm, reach.motor_rad_per_Nm);
    worst.link_rad_per_Nm = std::max(worst.link_rad_per_Nm, reach.link_rad_per_Nm);
    worst.position_rad_per_Nm = std::min(worst.position_rad_per_Nm, reach.position_rad_per_Nm);
    worst.velocity_rad_s_per_Nm = std::min(worst.velocity_rad_s_per_Nm, reach.velocity_rad_s_per_Nm);
  }
  return worst;
}

std::string describe(const TableReach& reach, double torque_Nm) {
  std::ostringstream text;
  text << std::setprecision(3) << "stand-off: at most " << 1e3 * reach.motor_rad_per_Nm
       << " mrad for each N m of unknown torque at the motor, " << 1e3 * reach.link_rad_per_Nm
       << " mrad at the link\nregion: returns from " << torque_Nm * reach.position_rad_per_Nm
       << " rad at rest, or from " << torque_Nm * reach.velocity_rad_s_per_Nm << " rad/s without error, if "
       << torque_Nm << " N m are left; in proportion with less\n";
  return text.str();
}

}  // namespace strainwave
