// SPDX-License-Identifier: BSD-3-Clause
// From friction rules and a joint to certified gains. Offline.
// Controllers, Zhao (2006) chapter 5: C1 (error, velocity; one gain), C2 (scheduled), C3 (with integrator;
// one gain), C4 (with integrator, scheduled).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "control/table/gain_table.h"
#include "design/gains/cost_certificate.h"
#include "design/gains/sdp_solver.h"

namespace strainwave {

enum class Controller { kC1, kC2, kC3, kC4 };
const char* name_of(Controller controller);
constexpr bool has_integrator(Controller controller) {
  return controller == Controller::kC3 || controller == Controller::kC4;
}
constexpr bool is_scheduled(Controller controller) {
  return controller == Controller::kC2 || controller == Controller::kC4;
}

struct DesignRequest {
  PlantIdentity plant;
  Sampling sampling =
      Sampling::kZeroOrderHold;  ///< forward Euler: to reproduce Zhao (2006), not for a machine
  FuzzyFriction friction;
  CostWeights weights;  ///< nominal; the integral's counts only for C3 and C4
  /// Initial states [integral rad.s, error rad, velocity rad/s] whose convex hull the bounds hold for; the
  /// integral is ignored for C1 and C2.
  std::vector<StateVector> initial_states;
  double margin = 0.01;  ///< the design's weights and limits are tightened by this fraction, so that the
                         ///< certificate has room
  double mistaken_share = 0.0;          ///< see ControllerProblem; design_gains() sets it where it is needed
  double decay_rate = 1.0;              ///< V falls at least by its square each sample
  std::optional<double> max_torque_Nm;  ///< of the feedback (Theorem 2), for every initial state
  std::optional<double> max_position_rad;  ///< of the position error (Theorem 3)
  std::optional<double> max_velocity_rad_s;
  std::optional<double> max_integral_rad_s;
};

/// Corners of the box |x_i| <= half_width_i. Both signs of a corner have the same cost: half of them are enough.
std::vector<StateVector> box_vertices(const StateVector& half_width);

/// Throws InputError naming the field: what no design can satisfy or is not finite.
void check_request(const DesignRequest& request);

struct DesignedGains {
  FeedbackGains
      gains;  ///< weights are the nominal ones; cost_bound = max over rules and initial states of x0' P_j x0
  CertificateReport certificate;  ///< of `gains` at the nominal weights, on the plant as `sampling` says
  double lambda = 0.0;            ///< the SDP's objective, at the inflated weights
  double violation = 0.0;         ///< of its inequalities
  bool bounds_hold =
      false;  ///< P_j of every rule proves the requested limits (true when none were requested)
};

/// Solves the LMIs. Throws NotAchieved: that there is none, where that is proved, else that the solver
/// failed. Does not insist on the certificate.
DesignedGains solve_gains(Controller controller, const DesignRequest& request);

/// The same, and throws NotAchieved unless certificate and limits hold. The first attempt asks for the pairs of
/// the certificate only. Where others fail, the next ask for mistaken rules, too, with a hundredth, a tenth and
/// at last all of the cost: from that everything follows, and every rule has the same gain.
DesignedGains design_gains(Controller controller, const DesignRequest& request);

/// A whole table, certified.
struct TableRequest {
  DesignRequest design;
  std::string name;
  double torque_limit_Nm = 0.0;
  EncoderSide encoder_side = EncoderSide::kMotor;
  std::string friction_sha256;
  std::string note;  ///< of the table's provenance
  std::string created_utc;
};
GainTable design_table(Controller controller, const TableRequest& request);

}  // namespace strainwave
