// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/controller_design.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/input_error.h"
#include "control/table/gain_table_json.h"
#include "design/gains/controller_lmi.h"
#include "design/gains/euler_plant.h"
#include "design/gains/ts_plant.h"

namespace strainwave {

namespace {

constexpr double kLargestMargin = 0.5;
constexpr double kFirstMistakenShare = 0.01;  // a hundredth, a tenth, then all of the cost

// C1 and C2 have no integral, which is the first state.
Eigen::Index first_state(Controller controller) {
  return has_integrator(controller) ? 0 : 1;
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

void require(bool condition, const std::string& key, double value, const std::string& allowed) {
  if (!condition) throw InputError("gains", key, number(value), allowed);
}

void require_positive(const std::string& key, double value) {
  require(std::isfinite(value) && value > 0.0, key, value, "must be a finite number above 0");
}

std::vector<Eigen::VectorXd> reduced_states(Controller controller, const std::vector<StateVector>& states) {
  const Eigen::Index first = first_state(controller);
  std::vector<Eigen::VectorXd> reduced;
  for (const StateVector& state : states) {
    const Eigen::VectorXd tail = state.tail(kMaxStates - first);
    const bool seen = std::ranges::any_of(
        reduced, [&tail](const Eigen::VectorXd& other) { return tail == other || tail == -other; });
    if (!seen && !tail.isZero(0.0)) reduced.push_back(tail);
  }
  if (reduced.empty())
    throw InputError("gains: x0: every initial state is zero; give at least one error to recover from");
  return reduced;
}

struct StateLimit {
  std::optional<double> limit;
  Eigen::Index state;
};

std::vector<StateLimit> state_limits(Controller controller, const DesignRequest& request) {
  std::vector<StateLimit> limits{{request.max_position_rad, 1}, {request.max_velocity_rad_s, 2}};
  if (has_integrator(controller)) limits.push_back({request.max_integral_rad_s, 0});
  return limits;
}

std::vector<BoundedDynamics> plant_rules(Controller controller, const DesignRequest& request) {
  const auto sample = request.sampling == Sampling::kForwardEuler ? euler_dynamics : bounded_dynamics;
  std::vector<BoundedDynamics> rules;
  rules.reserve(static_cast<std::size_t>(plant_rule_count(request.friction)));
  for (int j = 0; j < plant_rule_count(request.friction); ++j) {
    rules.push_back(
        sample(request.plant, plant_rule_viscous_Nms_rad(request.friction, j), has_integrator(controller)));
  }
  return rules;
}

ControllerProblem make_problem(Controller controller, const DesignRequest& request) {
  const Eigen::Index first = first_state(controller);
  const Eigen::Index n = kMaxStates - first;
  ControllerProblem problem;
  for (const BoundedDynamics& rule : plant_rules(controller, request)) {
    const SampledDynamics dynamics = rule.values();
    problem.A.push_back(dynamics.A.bottomRightCorner(n, n));
    problem.B.push_back(dynamics.B.tail(n));
  }
  const StateVector weights(request.weights.integral, request.weights.position, request.weights.velocity);
  problem.state_weights = (1.0 + request.margin) * weights.tail(n);
  problem.input_weight = (1.0 + request.margin) * request.weights.torque;
  problem.initial_states = reduced_states(controller, request.initial_states);
  problem.decay_rate = request.decay_rate;
  problem.mistaken_share = request.mistaken_share;
  problem.scheduled = is_scheduled(controller);
  const double tightened = 1.0 / std::sqrt(1.0 + request.margin);
  if (request.max_torque_Nm) problem.input_limit = tightened * *request.max_torque_Nm;
  for (const StateLimit& limit : state_limits(controller, request)) {
    if (!limit.limit) continue;
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(n);
    row(limit.state - first) = 1.0;
    problem.output_bounds.push_back({row, tightened * *limit.limit});
  }
  return problem;
}

// Suggests how to relax the request.
std::string advice(const DesignRequest& request) {
  std::string text;
  if (request.max_torque_Nm) text += " Allow more torque (--max-torque_Nm), or a smaller --x0.";
  if (request.max_position_rad || request.max_velocity_rad_s || request.max_integral_rad_s) {
    text +=
        " Relax --max-position_rad, --max-velocity_rad_s or --max-integral_rad_s, which must at least "
        "contain --x0.";
  }
  if (request.decay_rate < 1.0) text += " Ask for a slower decay (--decay-rate nearer to 1).";
  if (request.sampling == Sampling::kForwardEuler)
    text +=
        " Forward Euler misjudges a joint whose friction brakes it within a few periods (period * viscous / "
        "inertia near 1): --sampling zoh does not.";
  return text;
}

std::string failure_message(Controller controller, const DesignRequest& request,
                            const ControllerSolution& solution) {
  const std::string name = name_of(controller);
  if (solution.impossible)
    return "gains: no " + name + " exists for this request: its matrix inequalities contradict each other." +
           advice(request);
  return "gains: the solver failed on " + name + ": " + solution.explanation +
         ". Whether a solution exists is not known." + advice(request);
}

// x' P_j x <= cost_bound holds from the initial states on. If limit^2 P_j / cost_bound - row' row > 0, this
// implies |row x|^2 <= limit^2.
bool bound_holds(const FeedbackGains& gains, int rule, const GainRow& row, double limit) {
  const Eigen::Index first = gains.has_integrator ? 0 : 1;
  const Eigen::Index n = kMaxStates - first;
  StateMatrix room = StateMatrix::Zero();
  const StateMatrix full = (limit * limit / gains.cost_bound) * gains.lyapunov(rule) - row.transpose() * row;
  room.topLeftCorner(n, n) = full.bottomRightCorner(n, n);
  return test_positive_definite(room, StateMatrix(1e-14 * room.cwiseAbs()), static_cast<int>(n)).certain;
}

bool bounds_hold(Controller controller, const DesignRequest& request, const FeedbackGains& gains) {
  bool hold = true;
  for (int j = 0; j < gains.rule_count; ++j) {
    if (request.max_torque_Nm) hold = hold && bound_holds(gains, j, gains.gain(j), *request.max_torque_Nm);
    for (const StateLimit& limit : state_limits(controller, request)) {
      if (!limit.limit) continue;
      hold = hold && bound_holds(gains, j, GainRow::Unit(limit.state), *limit.limit);
    }
  }
  return hold;
}

double cost_bound(const FeedbackGains& gains, const std::vector<StateVector>& initial_states) {
  double bound = 0.0;
  for (int j = 0; j < gains.rule_count; ++j) {
    for (StateVector state : initial_states) {
      if (!gains.has_integrator) state(0) = 0.0;
      bound = std::max(bound, state.dot(gains.lyapunov(j) * state));
    }
  }
  return bound * (1.0 + 1e-12);  // rounding of the three products
}

}  // namespace

const char* name_of(Controller controller) {
  switch (controller) {
    case Controller::kC1:
      return "C1";
    case Controller::kC2:
      return "C2";
    case Controller::kC3:
      return "C3";
    case Controller::kC4:
      return "C4";
  }
  return "?";
}

std::vector<StateVector> box_vertices(const StateVector& half_width) {
  std::vector<StateVector> vertices;
  for (const double integral_sign : {1.0, -1.0}) {
    for (const double velocity_sign : {1.0, -1.0}) {
      const StateVector vertex(integral_sign * half_width(0), half_width(1), velocity_sign * half_width(2));
      if (std::ranges::find(vertices, vertex) == vertices.end()) vertices.push_back(vertex);
    }
  }
  return vertices;
}

void check_request(const DesignRequest& request) {
  require_positive("inertia_kgm2", request.plant.inertia_kgm2);
  require_positive("gear_ratio", request.plant.gear_ratio);
  require(request.plant.period_s >= 1e-5 && request.plant.period_s <= 1.0, "period_s", request.plant.period_s,
          "must be from 1e-5 to 1 second");
  require_positive("weights integral", request.weights.integral);
  require_positive("weights position", request.weights.position);
  require_positive("weights velocity", request.weights.velocity);
  require_positive("weights torque", request.weights.torque);
  require(request.margin >= 0.0 && request.margin <= kLargestMargin, "margin", request.margin,
          "must be from 0 to 0.5");
  require(request.decay_rate > 0.0 && request.decay_rate <= 1.0, "decay_rate", request.decay_rate,
          "must be above 0 and at most 1 (1: no demand)");
  for (const StateVector& state : request.initial_states) {
    if (!state.allFinite())
      throw InputError("gains: x0: must be three finite numbers: integral_rad_s,error_rad,velocity_rad_s");
  }
  if (request.max_torque_Nm) require_positive("max_torque_Nm", *request.max_torque_Nm);
  if (request.max_position_rad) require_positive("max_position_rad", *request.max_position_rad);
  if (request.max_velocity_rad_s) require_positive("max_velocity_rad_s", *request.max_velocity_rad_s);
  if (request.max_integral_rad_s) require_positive("max_integral_rad_s", *request.max_integral_rad_s);
}

DesignedGains solve_gains(Controller controller, const DesignRequest& request) {
  check_request(request);
  const ControllerSolution solution = solve_controller(make_problem(controller, request));
  if (solution.status != SdpStatus::kSolved)
    throw NotAchieved(failure_message(controller, request, solution));
  DesignedGains designed;
  FeedbackGains& gains = designed.gains;
  gains.controller = std::string_view(name_of(controller));
  gains.has_integrator = has_integrator(controller) ? 1 : 0;
  gains.rule_count = static_cast<std::int32_t>(solution.F.size());
  gains.weights = request.weights;
  if (!has_integrator(controller)) gains.weights.integral = 0.0;
  gains.decay_rate = request.decay_rate;
  const Eigen::Index n = kMaxStates - first_state(controller);
  for (std::size_t j = 0; j < solution.F.size(); ++j) {
    GainRow F = GainRow::Zero();
    StateMatrix P = StateMatrix::Zero();
    F.tail(n) = solution.F[j];
    P.bottomRightCorner(n, n) = solution.P[j];
    gains.set(static_cast<int>(j), F, P);
  }
  gains.cost_bound = cost_bound(gains, request.initial_states);
  designed.lambda = solution.lambda;
  designed.violation = solution.violation;
  designed.certificate = certify(gains, plant_rules(controller, request));
  designed.bounds_hold = bounds_hold(controller, request, gains);
  return designed;
}

DesignedGains design_gains(Controller controller, const DesignRequest& request) {
  DesignRequest attempt = request;
  for (;;) {
    DesignedGains designed = solve_gains(controller, attempt);
    if (designed.certificate.certified && designed.bounds_hold) return designed;
    const bool mistaken = designed.certificate.worst.kind != Inequality::kPair;
    if (mistaken && is_scheduled(controller) && attempt.mistaken_share < 1.0) {
      attempt.mistaken_share = std::max(kFirstMistakenShare, 10.0 * attempt.mistaken_share);
      continue;
    }
    throw NotAchieved(std::string("gains: ") + name_of(controller) + " was designed but " +
                      (designed.certificate.certified
                           ? "its limits are not proved"
                           : "is not certified (margin " + describe(designed.certificate.worst) + ")") +
                      " at margin " + number(attempt.margin) +
                      "; nothing is written. Use a larger --margin (0.01 is the default).");
  }
}

GainTable design_table(Controller controller, const TableRequest& request) {
  GainTable table;
  table.name = std::string_view(request.name);
  table.plant = request.design.plant;
  table.friction = request.design.friction;
  table.torque_limit_Nm = request.torque_limit_Nm;
  table.box.encoder_side = request.encoder_side;
  table.provenance.created_utc = std::string_view(request.created_utc);
  table.provenance.tool = std::string_view("strainwave-design " STRAINWAVE_VERSION);
  table.provenance.friction_sha256 = std::string_view(request.friction_sha256);
  table.provenance.note = std::string_view(request.note);
  table.provenance.sampling = request.design.sampling;
  table.primary = design_gains(controller, request.design).gains;
  if (const auto defect = find_defect(table)) throw InputError("gains: " + *defect);
  return table;
}

}  // namespace strainwave
