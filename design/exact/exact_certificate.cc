// SPDX-License-Identifier: BSD-3-Clause
#include "design/exact/exact_certificate.h"

#include <stdexcept>

#include "design/exact/exact_spring.h"
#include "design/exact/least_fall.h"

namespace strainwave {

namespace {

/// One controller of the table in its own states: [e, w], with the integral before them if it has one.
struct Controller {
  std::size_t first = 0;  ///< of the table's states
  std::size_t states = 3;
  std::vector<RationalMatrix> F;        ///< rows
  std::vector<RationalMatrix> P;        ///< one of each gain
  std::vector<RationalMatrix> allowed;  ///< P - W - F' R F
  mpq_class by_rate;                    ///< 1 / rho^2
};

Controller controller_of(const FeedbackGains& gains) {
  Controller result;
  result.first = gains.has_integrator != 0 ? 0 : 1;
  result.states = 3 - result.first;
  const mpq_class rate = gains.decay_rate;
  result.by_rate = 1 / (rate * rate);
  const std::vector<mpq_class> weights{gains.weights.integral, gains.weights.position,
                                       gains.weights.velocity};
  for (int rule = 0; rule < gains.rule_count; ++rule) {
    RationalMatrix F(1, result.states);
    RationalMatrix P(result.states, result.states);
    RationalMatrix W(result.states, result.states);
    for (std::size_t i = 0; i < result.states; ++i) {
      const std::size_t row = result.first + i;
      F(0, i) = gains.F[static_cast<std::size_t>(rule)][row];
      W(i, i) = weights[row];
      for (std::size_t j = 0; j < result.states; ++j)
        P(i, j) = gains.P[static_cast<std::size_t>(rule)][3 * row + result.first + j];
    }
    result.allowed.push_back(P - W - mpq_class(gains.weights.torque) * (transpose(F) * F));
    result.F.push_back(std::move(F));
    result.P.push_back(std::move(P));
  }
  return result;
}

/// [A B] of the rigid joint with this viscous friction, its integral first if `controller` has one.
Enclosure rigid_plant(const PlantIdentity& plant, const mpq_class& viscous_Nms_rad,
                      const Controller& controller) {
  const mpq_class h = plant.period_s;
  const mpq_class J = plant.inertia_kgm2;
  RationalMatrix M(3, 3);  // [e, w, u]
  M(0, 1) = h;
  M(1, 1) = -h * viscous_Nms_rad / J;
  M(1, 2) = h / J;
  const Enclosure sampled = exponential(M, {1, 1, J});
  const std::size_t n = controller.states;
  Enclosure result{RationalMatrix(n, n + 1), RationalMatrix(n, n + 1)};
  const std::size_t e = n - 2;
  if (e == 1) {
    result.value(0, 0) = 1;
    result.value(0, 1) = h;
  }
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      result.value(e + i, e + j) = sampled.value(i, j);
      result.radius(e + i, e + j) = sampled.radius(i, j);
    }
  return result;
}

/// A + B F.
Enclosure rigid_loop(const Enclosure& plant, const RationalMatrix& F) {
  const std::size_t n = F.columns();
  Enclosure H{RationalMatrix(n, n), RationalMatrix(n, n)};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      H.value(i, j) = plant.value(i, j) + plant.value(i, n) * F(0, j);
      H.radius(i, j) = plant.radius(i, j) + plant.radius(i, n) * abs(F(0, j));
    }
  return H;
}

Enclosure mean(const Enclosure& a, const Enclosure& b) {
  const mpq_class half(1, 2);
  return {half * (a.value + b.value), half * (a.radius + b.radius)};
}

std::string rule_text(const char* what, std::size_t rule) {
  return what + std::to_string(rule);
}

class RigidProof {
 public:
  RigidProof(const GainTable& table, const FeedbackGains& gains, ExactReport& report)
      : name_(gains.controller.view()), controller_(controller_of(gains)), report_(report) {
    plants_.push_back(rigid_plant(table.plant, 0, controller_));
    for (int rule = 0; rule < table.friction.rule_count; ++rule)
      plants_.push_back(rigid_plant(
          table.plant, table.friction.rules[static_cast<std::size_t>(rule)].friction.viscous_Nms_rad,
          controller_));
  }

  void prove() {
    const std::size_t gains = controller_.F.size();
    for (std::size_t j = 0; j < gains; ++j) {
      check(is_positive_definite(controller_.P[j]), rule_text("P of gain rule ", j));
      for (std::size_t i = 0; i < plants_.size(); ++i) {
        const bool own = gains == 1 || i == j;
        prove_step(own ? controller_.allowed[j] : controller_.P[j], rigid_loop(plants_[i], controller_.F[j]),
                   1, rule_text("plant rule ", i) + rule_text(" under gain rule ", j));
      }
      for (std::size_t k = j + 1; k < gains; ++k)
        prove_step(controller_.allowed[j] + controller_.allowed[k],
                   mean(rigid_loop(plants_[j], controller_.F[k]), rigid_loop(plants_[k], controller_.F[j])),
                   2, rule_text("the blend of rules ", j) + rule_text(" and ", k));
    }
  }

 private:
  // To every next rule.
  void prove_step(const RationalMatrix& allowed, const Enclosure& H, int copies, const std::string& what) {
    for (std::size_t l = 0; l < controller_.P.size() && report_.certified; ++l)
      check(falls(allowed, controller_.P[l], H, copies * controller_.by_rate),
            what + rule_text(", to rule ", l));
  }

  void check(bool holds, const std::string& what) {
    if (!report_.certified) return;
    ++report_.inequalities;
    report_.certified = holds;
    if (!holds) report_.refusal = "rigid joint, " + name_ + ": no proof of " + what;
  }

  std::string name_;
  Controller controller_;
  std::vector<Enclosure> plants_;
  ExactReport& report_;
};

/// Whether cells of this delay cover the rectangle: one holds it, or both parts of a cut at a cell's edge are covered.
bool is_covered(const CertifiedBox& box, int delay, const BoxRange& K, const BoxRange& Jl) {
  for (int i = 0; i < box.cell_count; ++i) {
    const BoxCell& cell = box.cells[static_cast<std::size_t>(i)];
    if (cell.delay_periods == delay && cell.stiffness_Nm_rad.holds(K.from) &&
        cell.stiffness_Nm_rad.holds(K.to) && cell.link_inertia_kgm2.holds(Jl.from) &&
        cell.link_inertia_kgm2.holds(Jl.to))
      return true;
  }
  const auto inside = [](const BoxRange& range, double edge) { return edge > range.from && edge < range.to; };
  for (int i = 0; i < box.cell_count; ++i) {
    const BoxCell& cell = box.cells[static_cast<std::size_t>(i)];
    for (const double edge : {cell.stiffness_Nm_rad.from, cell.stiffness_Nm_rad.to})
      if (inside(K, edge))
        return is_covered(box, delay, {K.from, edge}, Jl) && is_covered(box, delay, {edge, K.to}, Jl);
    for (const double edge : {cell.link_inertia_kgm2.from, cell.link_inertia_kgm2.to})
      if (inside(Jl, edge))
        return is_covered(box, delay, K, {Jl.from, edge}) && is_covered(box, delay, K, {edge, Jl.to});
  }
  return false;
}

void prove_box(const GainTable& table, ExactReport& report) {
  const CertifiedBox& box = table.box;
  for (int delay = box.least_delay; delay <= box.most_delay; ++delay) {
    if (is_covered(box, delay, box.stiffness_Nm_rad, box.link_inertia_kgm2)) continue;
    report.certified = false;
    report.refusal = "a part of the box has no cell with a delay of " + std::to_string(delay);
    return;
  }
  for (int i = 0; i < box.cell_count && report.certified; ++i)
    prove_cell(table, box.cells[static_cast<std::size_t>(i)], report);
}

}  // namespace

ExactReport certify_exactly(const GainTable& table) {
  ExactReport report{true, 0, {}};
  try {
    for (const FeedbackGains* gains : {&table.primary, &table.fallback})
      RigidProof(table, *gains, report).prove();
    if (report.certified && !table.box.rigid()) prove_box(table, report);
  } catch (const std::domain_error& error) {
    report.certified = false;
    report.refusal = error.what();
  }
  return report;
}

}  // namespace strainwave
