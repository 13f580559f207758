// SPDX-License-Identifier: BSD-3-Clause
// Designs certified gains from friction rules and a joint. Offline.
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
      Sampling::kZeroOrderHold;  ///< forward Euler only reproduces Zhao (2006); not for a real joint
  FuzzyFriction friction;
  CostWeights weights;  ///< nominal; the integral's weight counts for C3 and C4 only
  /// Initial states [integral rad.s, error rad, velocity rad/s]. The bounds hold for their convex hull. C1
  /// and C2 ignore the integral.
  std::vector<StateVector> initial_states;
  double margin = 0.01;         ///< the design tightens weights and limits by this fraction, so that the
                                ///< certificate has room
  double mistaken_share = 0.0;  ///< see ControllerProblem; design_gains() sets it if needed
  double decay_rate = 1.0;      ///< r: V falls at least by the factor r^2 in each sample
  std::optional<double> max_torque_Nm;     ///< limit of the feedback (Theorem 2), for every initial state
  std::optional<double> max_position_rad;  ///< limit of the position error (Theorem 3)
  std::optional<double> max_velocity_rad_s;
  std::optional<double> max_integral_rad_s;
};

/// Corners of the box |x_i| <= half_width_i. Opposite corners have the same cost, so that half of them are enough.
std::vector<StateVector> box_vertices(const StateVector& half_width);

/// Throws InputError, which names the field, if a value is not finite or no design can satisfy it.
void check_request(const DesignRequest& request);

struct DesignedGains {
  FeedbackGains
      gains;  ///< with the nominal weights; cost_bound = max over rules and initial states of x0' P_j x0
  CertificateReport certificate;  ///< of `gains` at the nominal weights, on the plant of `sampling`
  double lambda = 0.0;            ///< objective of the SDP, at the tightened weights
  double violation = 0.0;         ///< of the SDP's inequalities
  bool bounds_hold =
      false;  ///< P_j of every rule proves the requested limits (true when none were requested)
};

/// Solves the LMIs. Throws NotAchieved, which says that there is no solution if that is proved, else that the
/// solver failed. The certificate need not hold.
DesignedGains solve_gains(Controller controller, const DesignRequest& request);

/// The same, but throws NotAchieved unless certificate and limits hold. The first attempt requires only the pairs
/// of the certificate. If others fail, further attempts also require the mistaken rules, with 0.01, 0.1 and at
/// last all of the cost. The last attempt implies every inequality, and gives every rule the same gain.
DesignedGains design_gains(Controller controller, const DesignRequest& request);

/// Request of a whole table, whose gains design_table() certifies.
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
