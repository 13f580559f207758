#include "control/spring_certificate.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "control/positive_definite.h"

namespace strainwave {

namespace {

constexpr std::size_t kDimensions = 4;  // stiffness, 1 / Jl, damping, viscous friction
constexpr std::size_t kCorners = std::size_t{1} << kDimensions;

// Bit d of `corner` says which end of dimension d it is at.
SpringPlant corner_of(const SpringBox& box, std::size_t corner) {
  const auto end = [corner](std::size_t d, const BoxRange& range) {
    return (corner >> d & 1U) != 0 ? range.to : range.from;
  };
  return {box.motor_inertia_kgm2, end(1, box.link_inertia_kgm2), end(0, box.stiffness_Nm_rad),
          end(2, box.damping_Nms_rad), end(3, box.viscous_Nms_rad)};
}

// From the smallest to the largest in `cells` equal ratios; the ends exactly.
std::vector<double> borders(double from, double to, int cells) {
  std::vector<double> result{from};
  for (int i = 1; i < cells; ++i)
    result.push_back(from * std::pow(to / from, static_cast<double>(i) / cells));
  result.push_back(to);
  return result;
}

}  // namespace

std::vector<SpringCorner> spring_corners(const SpringBox& box, double period_s) {
  std::vector<SpringCorner> corners(kCorners);
  std::array<BoundedMatrix, kCorners> generators;
  ProofMatrix size = ProofMatrix::Zero(kSpringPlantStates + 1, kSpringPlantStates + 1);
  for (std::size_t c = 0; c < kCorners; ++c) {
    corners[c].plant = corner_of(box, c);
    generators[c] = spring_generator(corners[c].plant, period_s);
    corners[c].sampled = spring_exponential(generators[c]);
    size = size.cwiseMax(generators[c].magnitude());
  }
  ProofMatrix error = ProofMatrix::Zero(size.rows(), size.cols());
  for (std::size_t d = 0; d < kDimensions; ++d) {
    ProofMatrix change = ProofMatrix::Zero(size.rows(), size.cols());
    for (std::size_t c = 0; c < kCorners; ++c) {
      if ((c >> d & 1U) != 0) continue;
      change = change.cwiseMax((generators[c | std::size_t{1} << d] - generators[c]).magnitude());
    }
    error += interpolation_error(size, change);
  }
  for (SpringCorner& corner : corners)
    corner.sampled.error = BoundedMatrix::kUp * (corner.sampled.error + error);
  return corners;
}

std::vector<SpringBox> spring_cells(const SpringBox& box, int stiffness_cells, int inertia_cells) {
  const double motor_1_kgm2 = 1.0 / box.motor_inertia_kgm2;
  const BoxRange& link = box.link_inertia_kgm2;
  std::vector<double> inertias =
      borders(motor_1_kgm2 + 1.0 / link.from, motor_1_kgm2 + 1.0 / link.to, inertia_cells);
  for (double& inertia : inertias) inertia = 1.0 / (inertia - motor_1_kgm2);
  inertias.front() = link.from;
  inertias.back() = link.to;
  const std::vector<double> stiffness =
      borders(box.stiffness_Nm_rad.from, box.stiffness_Nm_rad.to, stiffness_cells);
  std::vector<SpringBox> cells;
  for (std::size_t k = 0; k + 1 < stiffness.size(); ++k) {
    for (std::size_t j = 0; j + 1 < inertias.size(); ++j) {
      cells.push_back(box);
      cells.back().stiffness_Nm_rad = {stiffness[k], stiffness[k + 1]};
      cells.back().link_inertia_kgm2 = {inertias[j], inertias[j + 1]};
    }
  }
  return cells;
}

SpringReport certify(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                     const ProofMatrix& P) {
  const auto states = static_cast<int>(P.rows());
  const BoundedMatrix lyapunov(P);
  const Bounded by_rate = Bounded(1.0) / (Bounded(loop.decay_rate) * loop.decay_rate);
  const PositiveDefiniteResult positive = test_positive_definite(P, lyapunov.error, states);
  SpringReport report{positive.certain, 1, positive.margin, corner_of(box, 0), 0};
  for (const SpringCorner& corner : spring_corners(box, loop.period_s)) {
    for (std::size_t j = 0; j < gains.size(); ++j) {
      const BoundedMatrix H = spring_loop(corner.sampled, gains[j], loop.period_s, loop.delay_periods);
      const BoundedMatrix fall = lyapunov - by_rate * (H.transpose() * (lyapunov * H));
      const PositiveDefiniteResult result = test_positive_definite(fall.value, fall.error, states);
      report.certified = report.certified && result.certain;
      ++report.inequalities;
      if (!(result.margin < report.margin)) continue;
      report.margin = result.margin;
      report.worst = corner.plant;
      report.worst_gain = static_cast<int>(j);
    }
  }
  return report;
}

double spring_loop_radius(const SpringPlant& plant, const GainRow& gain, const SpringLoop& loop) {
  const BoundedMatrix sampled = spring_exponential(spring_generator(plant, loop.period_s));
  const ProofMatrix H = spring_loop(sampled, gain, loop.period_s, loop.delay_periods).value;
  if (!H.allFinite()) return std::numeric_limits<double>::infinity();
  return Eigen::EigenSolver<ProofMatrix>(H, false).eigenvalues().cwiseAbs().maxCoeff();
}

std::string describe(const SpringReport& report) {
  std::ostringstream text;
  text << std::setprecision(3);
  if (std::isfinite(report.margin)) {
    text << report.margin;
  } else {
    text << "none (not positive on its diagonal)";
  }
  text << ", link " << report.worst.link_inertia_kgm2 << " kg m2, stiffness " << std::setprecision(5)
       << report.worst.stiffness_Nm_rad << " N m/rad, damping " << report.worst.damping_Nms_rad
       << " N m s/rad, viscous " << report.worst.viscous_Nms_rad << " N m s/rad, gain rule "
       << report.worst_gain;
  return text.str();
}

}  // namespace strainwave
