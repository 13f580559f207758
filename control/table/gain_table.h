// SPDX-License-Identifier: BSD-3-Clause
// The gain table: everything that the loop needs to control one kind of joint, and the data of its proof. A plain
// struct that can be copied as bytes. Real-time safe to read. Source: Zhao (2006), chapter 5; see docs/theory.md.
//
// State of the error dynamics, in this order:
//
//   x = [ integral of error (rad.s), error (rad), velocity (rad/s) ]
//   error = joint position - setpoint
//   u = F x, feedback torque (N.m, joint side), so stabilising gains are negative
//
// Controllers without an integrator keep the same layout with zeros in the integral's row and column.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "base/fixed_string.h"
#include "control/friction/fuzzy_friction.h"
#include "control/table/certified_box.h"

namespace strainwave {

inline constexpr int kMaxStates = 3;
/// The zero-velocity rule and one high-velocity rule per temperature rule.
inline constexpr int kMaxRules = 1 + kMaxTemperatureRules;
inline constexpr int kGainTableFormat = 1;

using StateVector = Eigen::Vector3d;
using StateMatrix = Eigen::Matrix3d;
using GainRow = Eigen::RowVector3d;

/// The plant that a table was designed for. The daemon refuses another joint's table. For a flexible joint the box decides on inertias.
struct PlantIdentity {
  FixedString<32> joint_model;  ///< e.g. "rhs17-6006"
  FixedString<32> gear;         ///< its name in data/gears.csv, e.g. "csf-17-50"; empty: unknown
  double inertia_kgm2 = 0.0;    ///< J > 0, at the joint side
  double gear_ratio = 0.0;      ///< N > 0
  double period_s = 0.0;        ///< ts > 0

  bool operator==(const PlantIdentity&) const = default;
};

/// Weights of the quadratic cost sum x'Wx + u'Ru with W = diag(integral, position, velocity), R = torque.
struct CostWeights {
  double integral = 0.0;  ///< 0 exactly when the controller has no integrator
  double position = 0.0;
  double velocity = 0.0;
  double torque = 0.0;

  bool operator==(const CostWeights&) const = default;
};

/// Gains of one controller with their Lyapunov matrices. Rule 0 is "zero velocity", rule i the i-th
/// temperature rule at high velocity. A temperature-free controller has rule_count 1: one gain for every rule
/// of the plant.
struct FeedbackGains {
  FixedString<8> controller;  ///< "C1".."C4"
  std::int32_t has_integrator = 0;
  std::int32_t rule_count = 0;
  CostWeights weights;
  double decay_rate = 1.0;  ///< in (0, 1]: V falls at least by its square each sample
  double cost_bound = 0.0;  ///< lambda: bound on the cost from the declared initial states
  std::array<std::array<double, kMaxStates>, kMaxRules> F{};  ///< F_j, 1x3 rows
  std::array<std::array<double, std::size_t{kMaxStates} * kMaxStates>, kMaxRules>
      P{};  ///< P_j, 3x3, symmetric, row by row

  GainRow gain(int rule) const noexcept { return GainRow::Map(F[static_cast<std::size_t>(rule)].data()); }
  StateMatrix lyapunov(int rule) const noexcept {
    return Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(P[static_cast<std::size_t>(rule)].data());
  }
  void set(int rule, const GainRow& gain, const StateMatrix& lyapunov) noexcept {
    GainRow::Map(F[static_cast<std::size_t>(rule)].data()) = gain;
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(P[static_cast<std::size_t>(rule)].data()) = lyapunov;
  }
  bool scheduled() const noexcept { return rule_count > 1; }
  bool operator==(const FeedbackGains&) const = default;
};

/// How the design sampled the plant: by forward Euler as Zhao (2006) did, or with held torque as the loop does.
enum class Sampling : std::int32_t { kForwardEuler = 0, kZeroOrderHold = 1 };

/// Origin of a table. Neither the loop nor a proof reads it.
struct Provenance {
  Sampling sampling = Sampling::kZeroOrderHold;
  FixedString<32> created_utc;      ///< ISO 8601
  FixedString<32> tool;             ///< program and version
  FixedString<72> friction_sha256;  ///< of the friction file that the rules came from, in hex
  FixedString<64> note;

  bool operator==(const Provenance&) const = default;
};

/// One table.
struct GainTable {
  std::int32_t format = kGainTableFormat;
  FixedString<48> name;
  PlantIdentity plant;  ///< the one inertia that the gains are designed for
  CertifiedBox box;     ///< the joints that the gains are certified on
  FuzzyFriction friction;
  double torque_limit_Nm = 0.0;  ///< symmetric, joint side; the joint's own limit applies as well
  FeedbackGains primary;         ///< C4 (or C1 to C3)
  Provenance provenance;

  bool operator==(const GainTable&) const = default;
};

/// Whether two numbers of a joint are equal except for their rounding in files: |a - b| <= 1e-9 |b|. False with NaN.
bool is_same_number(double a, double b) noexcept;

/// Whether the joint's inertia must equal the table's, or may be any inertia in its box.
enum class InertiaCheck { kSame, kOfTheBox };

/// Why `table` does not fit the joint that `expected` describes, or nothing. Compared are the model, the gear where both name one, and, by
/// is_same_number(), ratio, period and, if requested, inertia.
std::optional<std::string> find_identity_mismatch(const GainTable& table, const PlantIdentity& expected,
                                                  InertiaCheck inertia = InertiaCheck::kSame);

}  // namespace strainwave
