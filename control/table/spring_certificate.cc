// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/spring_certificate.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "control/table/positive_definite.h"

namespace strainwave {

namespace {

constexpr std::size_t kDimensions = 5;  // stiffness, 1 / Jl, damping, viscous friction, 1 / Jm
constexpr std::size_t kCorners = std::size_t{1} << kDimensions;

template <typename Box>
auto& range_of(Box& box, std::size_t dimension) {
  switch (dimension) {
    case 0:
      return box.stiffness_Nm_rad;
    case 1:
      return box.link_inertia_kgm2;
    case 2:
      return box.damping_Nms_rad;
    case 3:
      return box.viscous_Nms_rad;
    default:
      return box.motor_inertia_kgm2;
  }
}

// Bit d of `corner` selects the end of dimension d.
SpringPlant corner_of(const SpringBox& box, std::size_t corner) {
  const auto end = [&](std::size_t d) {
    return (corner >> d & 1U) != 0 ? range_of(box, d).to : range_of(box, d).from;
  };
  return {end(4), end(1), end(0), end(2), end(3)};
}

bool is_wide(const SpringBox& box, std::size_t dimension) {
  const BoxRange& range = range_of(box, dimension);
  return range.from != range.to;
}

// Whether the corner differs from earlier ones: a dimension without width has only one end.
bool is_new(const SpringBox& box, std::size_t corner) {
  for (std::size_t d = 0; d < kDimensions; ++d)
    if ((corner >> d & 1U) != 0 && !is_wide(box, d)) return false;
  return true;
}

}  // namespace

SpringCorners spring_corners(const SpringBox& box, double period_s) {
  SpringCorners result;
  std::array<BoundedMatrix, kCorners> generators;
  ProofMatrix size = spring_generator(corner_of(box, 0), period_s).magnitude();
  for (std::size_t c = 0; c < kCorners; ++c) {
    generators[c] = spring_generator(corner_of(box, c), period_s);
    size = size.cwiseMax(generators[c].magnitude());
    if (!is_new(box, c)) continue;
    result.corners.push_back({corner_of(box, c), spring_exponential(generators[c])});
  }
  std::array<ProofMatrix, kDimensions> errors;
  result.interpolation = ProofMatrix::Zero(size.rows(), size.cols());
  for (std::size_t d = 0; d < kDimensions; ++d) {
    ProofMatrix change = ProofMatrix::Zero(size.rows(), size.cols());
    for (std::size_t c = 0; c < kCorners; ++c) {
      if ((c >> d & 1U) != 0) continue;
      change = change.cwiseMax((generators[c | std::size_t{1} << d] - generators[c]).magnitude());
    }
    errors[d] = is_wide(box, d) ? interpolation_error(size, change) : result.interpolation * 0.0;
    result.interpolation += errors[d];
  }
  double largest = 0.0;
  for (std::size_t d = 0; d < kDimensions; ++d) {
    const double share =
        (errors[d].array() / (result.interpolation.array() + std::numeric_limits<double>::min())).sum();
    if (share <= largest) continue;
    largest = share;
    result.widest = d;
  }
  return result;
}

// Any l > 0 gives a proof; this choice makes both terms equally large in the norm of the fall.
BoundedMatrix least_fall(const BoundedMatrix& P, const BoundedMatrix& H) {
  const Eigen::Index n = P.value.rows();
  const BoundedMatrix middle(H.value);
  const BoundedMatrix PH = P * middle;
  const ProofMatrix fall_of_middle = P.value - H.value.transpose().lazyProduct(PH.value);
  const ProofMatrix by_fall = fall_of_middle.inverse();
  ProofMatrix a = ProofMatrix::Zero(n, n);
  ProofMatrix b = ProofMatrix::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const ProofMatrix row = PH.value.row(i);
    const double of_row = std::sqrt(row.lazyProduct(by_fall).lazyProduct(row.transpose())(0, 0));
    for (Eigen::Index j = 0; j < n; ++j) {
      if (H.error(i, j) == 0.0) continue;
      const double l = std::sqrt(by_fall(j, j)) / of_row;
      a(i, i) += BoundedMatrix::kUp * H.error(i, j) * l;
      b(j, j) += BoundedMatrix::kUp * H.error(i, j) / l;
    }
  }
  const BoundedMatrix twice = middle.transpose() + PH.transpose() * BoundedMatrix(BoundedMatrix::kUp * a);
  BoundedMatrix fall = P - (twice * PH + BoundedMatrix(BoundedMatrix::kUp * b));
  const ProofMatrix of_P = P.magnitude().lazyProduct(H.error);
  const ProofMatrix second = H.error.transpose().lazyProduct(of_P);
  fall.error = BoundedMatrix::kUp * (fall.error + second);
  return fall;
}

namespace {

enum class Outcome { kProved, kLostBetweenCorners, kRefused };

class BoxProof {
 public:
  BoxProof(std::span<const GainRow> gains, const SpringLoop& loop, const ProofMatrix& P,
           int most_inequalities)
      : gains_(gains), loop_(loop), P_(P), most_inequalities_(most_inequalities) {
    const PositiveDefiniteResult positive = test_positive_definite(P, P_.error, states());
    report_.certified = positive.certain;
    report_.margin = positive.margin;
    report_.inequalities = 1;
  }

  void prove(const SpringBox& box, int cuts) {
    const SpringCorners corners = spring_corners(box, loop_.period_s);
    const Outcome outcome = test(corners);
    if (outcome == Outcome::kProved || !report_.certified) return;
    if (outcome == Outcome::kRefused || cuts == 0 || report_.inequalities > most_inequalities_) {
      report_.certified = false;
      return;
    }
    SpringBox half = box;
    const BoxRange whole = range_of(box, corners.widest);
    const double middle = 0.5 * (whole.from + whole.to);
    range_of(half, corners.widest) = {whole.from, middle};
    prove(half, cuts - 1);
    range_of(half, corners.widest) = {middle, whole.to};
    prove(half, cuts - 1);
  }

  const SpringReport& report() const { return report_; }

 private:
  int states() const { return static_cast<int>(P_.value.rows()); }

  PositiveDefiniteResult test(const BoundedMatrix& sampled, const GainRow& gain) {
    const BoundedMatrix fall = least_fall(P_, spring_loop(sampled, gain, loop_));
    ++report_.inequalities;
    return test_positive_definite(fall.value, fall.error, states());
  }

  // A proof reports the least margin of its proved parts, a refusal that of the corner that fails.
  Outcome test(const SpringCorners& box) {
    SpringReport found = report_;
    for (const SpringCorner& corner : box.corners) {
      BoundedMatrix sampled = corner.sampled;
      sampled.error = BoundedMatrix::kUp * (sampled.error + box.interpolation);
      for (std::size_t j = 0; j < gains_.size(); ++j) {
        PositiveDefiniteResult result = test(sampled, gains_[j]);
        const bool lost = !result.certain;
        if (lost) result = test(corner.sampled, gains_[j]);
        if (result.margin < found.margin) {
          found.margin = result.margin;
          found.worst = corner.plant;
          found.worst_gain = static_cast<int>(j);
        }
        if (!lost) continue;
        found.inequalities = report_.inequalities;
        if (!result.certain) report_ = found;
        return result.certain ? Outcome::kLostBetweenCorners : Outcome::kRefused;
      }
    }
    found.inequalities = report_.inequalities;
    report_ = found;
    return Outcome::kProved;
  }

  std::span<const GainRow> gains_;
  SpringLoop loop_;
  BoundedMatrix P_;
  int most_inequalities_;
  SpringReport report_;
};

}  // namespace

SpringReport certify(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                     const ProofMatrix& P, int most_inequalities) {
  BoxProof proof(gains, loop, P, most_inequalities);
  if (proof.report().certified) proof.prove(box, kMostHalvings);
  return proof.report();
}

double spring_loop_radius(const SpringPlant& plant, const GainRow& gain, const SpringLoop& loop) {
  const BoundedMatrix sampled = spring_exponential(spring_generator(plant, loop.period_s));
  const ProofMatrix H = spring_loop(sampled, gain, loop).value;
  if (!H.allFinite()) return std::numeric_limits<double>::infinity();
  return Eigen::EigenSolver<ProofMatrix>(H, false).eigenvalues().cwiseAbs().maxCoeff();
}

WorstCorner worst_corner(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop) {
  WorstCorner worst;
  for (const SpringCorner& corner : spring_corners(box, loop.period_s).corners) {
    for (std::size_t j = 0; j < gains.size(); ++j) {
      const double radius = spring_loop_radius(corner.plant, gains[j], loop);
      if (!(radius <= worst.radius)) worst = {corner.plant, static_cast<int>(j), radius};
    }
  }
  return worst;
}

std::vector<GainRow> gains_of(const GainTable& table) {
  std::vector<GainRow> gains;
  gains.reserve(static_cast<std::size_t>(table.primary.rule_count));
  for (int rule = 0; rule < table.primary.rule_count; ++rule) gains.push_back(table.primary.gain(rule));
  return gains;
}

std::string describe(const SpringPlant& plant) {
  std::ostringstream text;
  text << std::setprecision(5);
  if (plant.link_inertia_kgm2 == 0.0) {
    text << "inertia " << plant.motor_inertia_kgm2 << " kg m2";
  } else {
    text << "motor " << plant.motor_inertia_kgm2 << " kg m2, link " << plant.link_inertia_kgm2
         << " kg m2, stiffness " << plant.stiffness_Nm_rad << " N m/rad, damping " << plant.damping_Nms_rad
         << " N m s/rad";
  }
  text << ", viscous friction " << plant.viscous_Nms_rad << " N m s/rad";
  return text.str();
}

std::string describe(const SpringReport& report) {
  std::ostringstream text;
  text << std::setprecision(3);
  if (std::isfinite(report.margin)) {
    text << report.margin;
  } else {
    text << "none (not positive on its diagonal)";
  }
  if (report.worst.motor_inertia_kgm2 == 0.0) {
    text << " of P itself";
  } else {
    text << " at " << describe(report.worst) << ", gain rule " << report.worst_gain;
  }
  return text.str();
}

}  // namespace strainwave
