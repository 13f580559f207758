// SPDX-License-Identifier: BSD-3-Clause
#include "design/exact/exact_spring.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/printable.h"
#include "control/joint/link_velocity.h"
#include "design/exact/least_fall.h"

namespace strainwave {

namespace {

// The directions of a part: stiffness, link inertia, damping, viscous friction, motor inertia.
constexpr std::size_t kDirections = 5;
constexpr std::size_t kCorners = std::size_t{1} << kDirections;
// More halvings than the first checker has, so that the rounding of l and s by up to 1.6 % does not decide a proof.
constexpr int kMostExactHalvings = kMostHalvings + 4;

using Joint = std::array<double, kDirections>;
using Part = std::array<BoxRange, kDirections>;

Joint corner_of(const Part& part, std::size_t corner) {
  Joint joint{};
  for (std::size_t d = 0; d < kDirections; ++d)
    joint[d] = (corner >> d & 1U) != 0 ? part[d].to : part[d].from;
  return joint;
}

std::string text_of(const Joint& joint) {
  if (joint[1] == 0.0) return "viscous friction " + number_text(joint[3]) + " N m s/rad";
  return "stiffness " + number_text(joint[0]) + " N m/rad, link " + number_text(joint[1]) +
         " kg m2, damping " + number_text(joint[2]) + " N m s/rad, viscous friction " +
         number_text(joint[3]) + " N m s/rad, motor " + number_text(joint[4]) + " kg m2";
}

RationalMatrix unit_row(std::size_t size, std::size_t place) {
  RationalMatrix row(1, size);
  row(0, place) = 1;
  return row;
}

void set_row(RationalMatrix& matrix, std::size_t row, const RationalMatrix& entries) {
  for (std::size_t j = 0; j < matrix.columns(); ++j) matrix(row, j) = entries(0, j);
}

/// h [Ac Bc; 0 0] with the states [e, w, s, v] and u. A rigid joint has no link, only [e, w] and u.
RationalMatrix generator(const Joint& joint, const mpq_class& h) {
  const mpq_class motor_inertia_kgm2 = joint[4];
  if (joint[1] == 0.0) {
    RationalMatrix rigid(3, 3);
    rigid(0, 1) = h;
    rigid(1, 1) = -h * mpq_class(joint[3]) / motor_inertia_kgm2;
    rigid(1, 2) = h / motor_inertia_kgm2;
    return rigid;
  }
  const mpq_class K = joint[0];
  const mpq_class Jl = joint[1];
  const mpq_class D = joint[2];
  const mpq_class b = joint[3];
  RationalMatrix spring(1, 5);  // K s + D v
  spring(0, 2) = K;
  spring(0, 3) = D;
  RationalMatrix on_motor = spring;
  on_motor(0, 1) -= b;
  on_motor(0, 4) = 1;
  const RationalMatrix motor = mpq_class(1 / motor_inertia_kgm2) * on_motor;
  RationalMatrix M(5, 5);
  M(0, 1) = 1;
  M(2, 3) = 1;
  set_row(M, 1, motor);
  set_row(M, 3, mpq_class(-1 / Jl) * spring - motor);
  return h * M;
}

/// The feedback of one gain, without the plant's own rows.
struct Feedback {
  RationalMatrix acting;  ///< the torque that acts on the motor, as a row
  RationalMatrix memory;  ///< the next state, zeros in the plant's rows
};

Feedback feedback(const GainRow& F, const GainTable& table, int delay) {
  const CertifiedBox& box = table.box;
  const mpq_class h = table.plant.period_s;
  const mpq_class lead = box.lead_periods;
  const mpq_class a = velocity_share(box.encoder_side, table.plant.period_s);
  const auto d = static_cast<std::size_t>(delay);
  const std::size_t reading = box.rigid() ? 3 : 5;
  const std::size_t n = reading + 1 + d + (lead != 0 ? 1 : 0);
  const RationalMatrix integral = unit_row(n, 0);
  const RationalMatrix z = unit_row(n, reading);
  RationalMatrix y = unit_row(n, 1);
  if (box.encoder_side == EncoderSide::kLink && !box.rigid()) y = y + unit_row(n, 3);
  const RationalMatrix velocity = mpq_class(a / h) * (y - z);
  const RationalMatrix law = mpq_class(F(0)) * integral + mpq_class(F(1)) * y + mpq_class(F(2)) * velocity;
  RationalMatrix torque = law;
  if (lead != 0) torque = mpq_class(1 + lead) * law - lead * unit_row(n, n - 1);

  Feedback result{d == 0 ? torque : unit_row(n, reading + d), RationalMatrix(n, n)};
  set_row(result.memory, 0, integral + h * y);
  set_row(result.memory, reading, z + a * (y - z));
  if (d > 0) set_row(result.memory, reading + 1, torque);
  for (std::size_t i = 1; i < d; ++i) set_row(result.memory, reading + 1 + i, unit_row(n, reading + i));
  if (lead != 0) set_row(result.memory, n - 1, law);
  return result;
}

/// `matrix` without its first `left_out` rows and columns.
RationalMatrix trimmed(const RationalMatrix& matrix, std::size_t left_out) {
  RationalMatrix result(matrix.rows() - left_out, matrix.columns() - left_out);
  for (std::size_t i = 0; i < result.rows(); ++i)
    for (std::size_t j = 0; j < result.columns(); ++j) result(i, j) = matrix(i + left_out, j + left_out);
  return result;
}

/// The closed loop of `sampled` = [A B; 0 1] and the feedback `by`.
Enclosure closed(const Enclosure& sampled, const Feedback& by) {
  const std::size_t n = by.memory.columns();
  const std::size_t plant = sampled.value.rows() - 1;
  Enclosure H{by.memory, RationalMatrix(n, n)};
  for (std::size_t i = 0; i < plant; ++i) {
    for (std::size_t j = 0; j < plant; ++j) {
      H.value(1 + i, 1 + j) += sampled.value(i, j);
      H.radius(1 + i, 1 + j) += sampled.radius(i, j);
    }
    for (std::size_t j = 0; j < n; ++j) {
      H.value(1 + i, j) += sampled.value(i, plant) * by.acting(0, j);
      H.radius(1 + i, j) += sampled.radius(i, plant) * abs(by.acting(0, j));
    }
  }
  return H;
}

RationalMatrix lyapunov_matrix(const BoxCell& cell, std::size_t n) {
  RationalMatrix P(n, n);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i; j < n; ++j) P(i, j) = P(j, i) = cell.P[entry++];
  return P;
}

class CellProof {
 public:
  CellProof(const GainTable& table, const BoxCell& cell, ExactReport& report)
      : left_out_(table.primary.has_integrator != 0 ? 0 : 1),
        period_s_(table.plant.period_s),
        delay_periods_(cell.delay_periods),
        report_(report) {
    for (int rule = 0; rule < table.primary.rule_count; ++rule)
      feedbacks_.push_back(feedback(table.primary.gain(rule), table, cell.delay_periods));
    P_ = trimmed(lyapunov_matrix(cell, feedbacks_.front().memory.columns()), left_out_);
    report_.inequalities += 1;
    if (!is_positive_definite(P_)) refuse("P is not positive definite");
  }

  void prove(const Part& part, int halvings) {
    if (!report_.certified || !is_lost_between(part)) return;
    if (halvings == 0) {
      refuse("no proof between the corners of a part near " + text_of(corner_of(part, 0)));
      return;
    }
    Part half = part;
    const BoxRange whole = part[widest_];
    const std::size_t cut = widest_;
    const double middle = 0.5 * (whole.from + whole.to);
    half[cut] = {whole.from, middle};
    prove(half, halvings - 1);
    half[cut] = {middle, whole.to};
    prove(half, halvings - 1);
  }

 private:
  // With these scales, at the natural frequency, velocities weigh as much as positions, and the stiffness as much as the torque.
  std::vector<mpq_class> scale(const Part& part) const {
    if (part[1].to == 0.0) return {1, 1, part[4].from};
    const double K = part[0].to;
    const mpq_class swing = short_number_near(std::sqrt(K * (1 / part[4].from + 1 / part[1].from)));
    return {1, swing, 1, swing, short_number_near(K)};
  }

  /// E of a part whose corners have these generators. Sets widest_ to the direction that contributes most.
  RationalMatrix interpolation(const std::array<RationalMatrix, kCorners>& generators, const Part& part) {
    const std::size_t n = generators[0].rows();
    RationalMatrix size(n, n);
    for (const RationalMatrix& M : generators) size = larger(size, magnitude(M));
    std::array<RationalMatrix, kDirections> bounds;
    RationalMatrix sum(n, n);
    for (std::size_t d = 0; d < kDirections; ++d) {
      RationalMatrix change(n, n);
      for (std::size_t c = 0; c < kCorners; ++c)
        change = larger(change, magnitude(generators[c | std::size_t{1} << d] - generators[c]));
      bounds[d] = RationalMatrix(n, n);
      if (part[d].from != part[d].to) bounds[d] = interpolation_bound(size, change, scale(part));
      sum = sum + bounds[d];
    }
    double most = 0.0;
    for (std::size_t d = 0; d < kDirections; ++d) {
      double share = 0.0;
      for (std::size_t i = 0; i < sum.rows(); ++i)
        for (std::size_t j = 0; j < sum.columns(); ++j)
          if (sum(i, j) != 0) share += bounds[d](i, j).get_d() / sum(i, j).get_d();
      if (share <= most) continue;
      most = share;
      widest_ = d;
    }
    return sum;
  }

  /// True if V falls at the corners but not within E of them. Refuses if V does not fall at a corner.
  bool is_lost_between(const Part& part) {
    std::array<RationalMatrix, kCorners> generators;
    for (std::size_t c = 0; c < kCorners; ++c) generators[c] = generator(corner_of(part, c), period_s_);
    const RationalMatrix E = interpolation(generators, part);
    for (std::size_t c = 0; c < kCorners; ++c) {
      const Joint joint = corner_of(part, c);
      bool repeated = false;
      for (std::size_t before = 0; before < c; ++before)
        repeated = repeated || corner_of(part, before) == joint;
      if (repeated) continue;
      const Enclosure sampled = exponential(generators[c], scale(part));
      for (std::size_t gain = 0; gain < feedbacks_.size(); ++gain) {
        report_.inequalities += 1;
        if (falls_within({sampled.value, sampled.radius + E}, feedbacks_[gain])) continue;
        if (falls_within(sampled, feedbacks_[gain])) return true;
        refuse("V does not fall under gain rule " + std::to_string(gain) + " at " + text_of(joint));
        return false;
      }
    }
    return false;
  }

  bool falls_within(const Enclosure& sampled, const Feedback& by) const {
    const Enclosure H = closed(sampled, by);
    return falls(P_, P_, {trimmed(H.value, left_out_), trimmed(H.radius, left_out_)}, 1);
  }

  void refuse(const std::string& why) {
    report_.certified = false;
    report_.refusal = "box, delay " + std::to_string(delay_periods_) + ": " + why;
  }

  std::size_t left_out_ = 0;  // 1 without an integrator: the integral is then no state
  mpq_class period_s_;
  int delay_periods_;
  std::vector<Feedback> feedbacks_;  // of every gain
  RationalMatrix P_;
  std::size_t widest_ = 0;
  ExactReport& report_;
};

}  // namespace

void prove_cell(const GainTable& table, const BoxCell& cell, ExactReport& report) {
  double most_viscous_Nms_rad = 0.0;
  for (int rule = 0; rule < table.friction.rule_count; ++rule)
    most_viscous_Nms_rad = std::max(
        most_viscous_Nms_rad, table.friction.rules[static_cast<std::size_t>(rule)].friction.viscous_Nms_rad);
  const BoxRange viscous_Nms_rad{0.0, most_viscous_Nms_rad};
  const double whole_kgm2 = table.plant.inertia_kgm2;
  CellProof(table, cell, report)
      .prove({cell.stiffness_Nm_rad, cell.link_inertia_kgm2, table.box.damping_Nms_rad, viscous_Nms_rad,
              table.box.rigid() ? BoxRange{whole_kgm2, whole_kgm2} : table.box.motor_inertia_kgm2},
             kMostExactHalvings);
}

}  // namespace strainwave
