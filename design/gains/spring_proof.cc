// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/spring_proof.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <iomanip>
#include <limits>
#include <list>
#include <sstream>
#include <thread>

#include "base/input_error.h"
#include "control/joint/gear_catalogue.h"
#include "design/gains/lmi.h"
#include "design/gains/ts_plant.h"

namespace strainwave {

namespace {

// Diagonal of W, the required decrease of V: integral, position and wind-up, their velocities, last reading, delayed torques.
// Only the ratios matter, and little. They are those of the design's cost weights; the wind-up weighs as much as the position.
constexpr double kIntegralFall = 0.1;
constexpr double kPositionFall = 1.0;
constexpr double kVelocityFall = 1e-4;
constexpr double kReadingFall = 1e-2;
constexpr double kTorqueFall = 1e-6;
// The sum of H'^k W H^k at one corner covers 2^kDoublings samples.
constexpr int kDoublings = 24;
// A cell with a smaller ratio of its ends is not cut. Without a P, it lies at the limit of what can be proved.
constexpr double kNarrowest = 1.002;

Eigen::VectorXd fall_of(const SpringLoop& loop) {
  std::vector<double> fall;
  if (loop.has_integrator) fall.push_back(kIntegralFall);
  for (int i = 0; i < loop.plant_states; ++i) fall.push_back(i % 2 == 0 ? kPositionFall : kVelocityFall);
  fall.push_back(kReadingFall);
  fall.resize(static_cast<std::size_t>(loop.states()), kTorqueFall);
  return Eigen::VectorXd::Map(fall.data(), loop.states());
}

std::vector<Eigen::MatrixXd> loops_of(std::span<const GainRow> gains, const SpringBox& box,
                                      const SpringLoop& loop) {
  std::vector<Eigen::MatrixXd> loops;
  for (const SpringCorner& corner : spring_corners(box, loop.period_s).corners)
    for (const GainRow& gain : gains) loops.emplace_back(spring_loop(corner.sampled, gain, loop).value);
  return loops;
}

// S of x = S z, from the mean diagonal of all Lyapunov matrices. If a loop is unstable, an entry is 0 or not finite.
Eigen::VectorXd balance(const std::vector<Eigen::MatrixXd>& loops, const Eigen::VectorXd& fall) {
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(fall.size());
  for (Eigen::MatrixXd H : loops) {
    Eigen::MatrixXd P = fall.asDiagonal();
    for (int k = 0; k < kDoublings; ++k) {
      P += (H.transpose() * P * H).eval();
      H = (H * H).eval();
    }
    largest += P.diagonal();
  }
  return (largest / static_cast<double>(loops.size())).cwiseSqrt().cwiseInverse();
}

AffineMatrix trace(const AffineMatrix& P) {
  AffineMatrix sum(1, 1);
  for (Eigen::Index i = 0; i < P.rows(); ++i) {
    const Eigen::MatrixXd row = Eigen::MatrixXd::Identity(P.rows(), P.rows()).row(i);
    sum = sum + row * (row * P).transpose();
  }
  return sum;
}

}  // namespace

std::optional<ProofMatrix> find_spring_lyapunov(std::span<const GainRow> gains, const SpringBox& box,
                                                const SpringLoop& loop, const SdpOptions& options) {
  const std::vector<Eigen::MatrixXd> loops = loops_of(gains, box, loop);
  const Eigen::VectorXd fall = fall_of(loop);
  const Eigen::VectorXd S = balance(loops, fall);
  if (!S.allFinite() || !(S.minCoeff() > 0.0)) return std::nullopt;
  LmiProblem lmi;
  const AffineMatrix P = lmi.symmetric(fall.size());
  const Eigen::MatrixXd wanted = (fall.array() * S.array().square()).matrix().asDiagonal();
  for (const Eigen::MatrixXd& loop_matrix : loops) {
    const Eigen::MatrixXd Ht = (S.cwiseInverse().asDiagonal() * loop_matrix * S.asDiagonal()).transpose();
    lmi.require_positive(P - Ht * (Ht * P).transpose() - AffineMatrix(wanted));
  }
  lmi.minimise(trace(P));
  const SdpResult result = solve_sdp(lmi, options);
  if (result.unknowns.size() == 0) return std::nullopt;
  const Eigen::VectorXd inverse = S.cwiseInverse();
  const Eigen::MatrixXd found = inverse.asDiagonal() * P.at(result.unknowns) * inverse.asDiagonal();
  ProofMatrix symmetric = 0.5 * (found + found.transpose());
  if (!symmetric.allFinite() || !certify(gains, box, loop, symmetric).certified) return std::nullopt;
  return symmetric;
}

namespace {

SpringPlant corner_plant(const SpringBox& box, bool upper) {
  const auto end = [upper](const BoxRange& range) { return upper ? range.to : range.from; };
  return {end(box.motor_inertia_kgm2), end(box.link_inertia_kgm2), end(box.stiffness_Nm_rad),
          end(box.damping_Nms_rad), end(box.viscous_Nms_rad)};
}

double inertia_ratio(const SpringBox& box) {
  const double motor_1_kgm2 = 1.0 / box.motor_inertia_kgm2.to;
  return (motor_1_kgm2 + 1.0 / box.link_inertia_kgm2.from) / (motor_1_kgm2 + 1.0 / box.link_inertia_kgm2.to);
}

double middle_of(const BoxRange& range) {
  return std::sqrt(range.from * range.to);
}

// The lightest link is the hardest. If it has one P for all stiffnesses, the stiffness may change at any instant.
bool may_change_stiffness(std::span<const GainRow> gains, SpringBox box, const SpringLoop& loop) {
  box.link_inertia_kgm2.to = box.link_inertia_kgm2.from;
  return find_spring_lyapunov(gains, box, loop).has_value();
}

// Cuts a cell in two at the geometric mean: of the link inertia if the stiffness range must stay whole, else
// of the quantity that changes the natural frequency more. Returns false if that range is narrow.
bool cut(const SpringBox& box, bool keeps_stiffness, std::array<SpringBox, 2>& halves) {
  if (box.link_inertia_kgm2.to == 0.0) return false;  // rigid
  const double by_stiffness = box.stiffness_Nm_rad.to / box.stiffness_Nm_rad.from;
  const bool stiffness = by_stiffness >= inertia_ratio(box) && !keeps_stiffness;
  if ((stiffness ? by_stiffness : inertia_ratio(box)) < kNarrowest) return false;
  halves = {box, box};
  const auto range = [stiffness](SpringBox& half) -> BoxRange& {
    return stiffness ? half.stiffness_Nm_rad : half.link_inertia_kgm2;
  };
  range(halves[0]).to = range(halves[1]).from = middle_of(range(halves[0]));
  return true;
}

// Result for a cell before it is cut.
struct Attempt {
  WorstCorner unstable;
  std::optional<ProofMatrix> P;
  bool keeps_stiffness = false;
};

Attempt attempt(std::span<const GainRow> gains, const SpringBox& cell, bool whole_stiffness,
                const SpringLoop& loop) {
  Attempt result{worst_corner(gains, cell, loop), {}, false};
  if (!(result.unstable.radius < 1.0)) return result;
  result.P = find_spring_lyapunov(gains, cell, loop);
  result.keeps_stiffness = !result.P && whole_stiffness && may_change_stiffness(gains, cell, loop);
  return result;
}

struct OpenCell {
  SpringBox box;
  std::future<Attempt> attempt;
};

}  // namespace

SpringProof prove_spring_box(std::span<const GainRow> gains, const SpringBox& box, const SpringLoop& loop,
                             int most_cells) {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  SpringProof proof;
  proof.most_cells = most_cells;
  proof.worst.margin = std::numeric_limits<double>::infinity();
  std::list<OpenCell> cells;
  cells.push_back({box, {}});
  const auto is_whole = [&box](const SpringBox& cell) {
    return cell.stiffness_Nm_rad.from == box.stiffness_Nm_rad.from &&
           cell.stiffness_Nm_rad.to == box.stiffness_Nm_rad.to;
  };
  for (auto next = cells.begin(); next != cells.end();) {
    // Starts as many of the next cells as there are processors. The solver runs in one process for each cell.
    unsigned under_way = 0;
    for (auto cell = next; cell != cells.end() && under_way < processors; ++cell, ++under_way) {
      if (!cell->attempt.valid())
        cell->attempt = std::async(std::launch::async, attempt, gains, cell->box, is_whole(cell->box), loop);
    }
    const Attempt result = next->attempt.get();
    proof.cell = next->box;
    proof.unstable = result.unstable;
    if (!(result.unstable.radius < 1.0)) {
      proof.outcome = SpringOutcome::kUnstable;
      return proof;
    }
    if (result.P) {
      const SpringReport report = certify(gains, proof.cell, loop, *result.P);
      proof.cells.push_back({proof.cell, *result.P});
      proof.inequalities += report.inequalities;
      if (report.margin < proof.worst.margin) proof.worst = report;
      ++next;
      continue;
    }
    std::array<SpringBox, 2> halves;
    if (static_cast<int>(cells.size()) + 1 > most_cells || !cut(proof.cell, result.keeps_stiffness, halves))
      return proof;
    next = cells.erase(next);
    for (const SpringBox& half : halves) next = cells.insert(next, OpenCell{half, {}});
  }
  proof.outcome = SpringOutcome::kCertified;
  return proof;
}

SpringBox spring_box(const FuzzyFriction& friction, const std::string& gear,
                     const BoxRange& motor_inertia_kgm2, const BoxRange& link_inertia_kgm2) {
  const Gear* const found = find_gear(gear);
  if (found == nullptr) throw InputError("spring", "gear", gear, "must be one of " + gear_names());
  const TorsionSpring& spring = found->spring;
  SpringBox box{motor_inertia_kgm2, link_inertia_kgm2, {}, {}, {}};
  box.stiffness_Nm_rad.from =
      std::min({spring.stiffness_1_Nm_rad, spring.stiffness_2_Nm_rad, spring.stiffness_3_Nm_rad});
  box.stiffness_Nm_rad.to =
      std::max({spring.stiffness_1_Nm_rad, spring.stiffness_2_Nm_rad, spring.stiffness_3_Nm_rad});
  box.viscous_Nms_rad.to = friction.largest_viscous_Nms_rad();
  return box;
}

std::string describe(const SpringProof& proof) {
  std::ostringstream text;
  switch (proof.outcome) {
    case SpringOutcome::kCertified:
      text << "certified, " << proof.cells.size() << (proof.cells.size() == 1 ? " cell, " : " cells, ")
           << proof.inequalities << " inequalities; smallest margin " << describe(proof.worst);
      break;
    case SpringOutcome::kUnstable:
      text << std::setprecision(5) << "UNSTABLE: eigenvalue " << proof.unstable.radius << " at "
           << describe(proof.unstable.plant) << ", gain rule " << proof.unstable.gain;
      break;
    case SpringOutcome::kNotFound:
      text << "NOT CERTIFIED: no proof found with at most " << proof.most_cells
           << " cells; the last one without a proof reaches from "
           << describe(corner_plant(proof.cell, false)) << " to " << describe(corner_plant(proof.cell, true));
      break;
  }
  return text.str();
}

}  // namespace strainwave
