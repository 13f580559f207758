// SPDX-License-Identifier: BSD-3-Clause
// Linear matrix inequalities (LMIs) written as in Zhao (2006): matrices that depend affinely on unknowns, and
// a list of those that must be positive semidefinite. Offline. The matrices are dense, for a few hundred
// unknowns and blocks of about ten rows.
//
//   LmiProblem lmi;
//   const AffineMatrix Q = lmi.symmetric(n), G = lmi.matrix(n, n), M = lmi.matrix(1, n);
//   lmi.require_positive(symmetric_blocks({{G + G.transpose() - Q}, {A * G + B * M, Q}}));
#pragma once

#include <Eigen/Core>
#include <cassert>
#include <map>
#include <string>
#include <vector>

namespace strainwave {

/// constant + sum_i x_i coefficient_i. All matrices have the same shape.
class AffineMatrix {
 public:
  /// An empty (0x0) matrix, which symmetric_blocks() takes for a block of zeros.
  AffineMatrix() = default;
  AffineMatrix(const Eigen::MatrixXd& constant)
      : constant_(constant) {}  // NOLINT(google-explicit-constructor)
  AffineMatrix(Eigen::Index rows, Eigen::Index columns) : constant_(Eigen::MatrixXd::Zero(rows, columns)) {}

  Eigen::Index rows() const { return constant_.rows(); }
  Eigen::Index cols() const { return constant_.cols(); }
  const Eigen::MatrixXd& constant() const { return constant_; }
  /// Coefficients by the number of their unknown. Unknowns that do not occur have no entry.
  const std::map<int, Eigen::MatrixXd>& coefficients() const { return coefficients_; }
  /// Adds x_unknown * coefficient.
  void add_term(int unknown, const Eigen::MatrixXd& coefficient);
  /// Adds `block` with its corner at (row, column).
  void add_block(Eigen::Index row, Eigen::Index column, const AffineMatrix& block);

  AffineMatrix transpose() const;
  /// The value at `unknowns`.
  Eigen::MatrixXd at(const Eigen::VectorXd& unknowns) const;

  // Friends that are defined here are found for this class only. Otherwise every MatrixXd would convert.
  friend AffineMatrix operator+(AffineMatrix a, const AffineMatrix& b) {
    assert(a.rows() == b.rows() && a.cols() == b.cols());
    a.constant_ += b.constant_;
    for (const auto& [unknown, coefficient] : b.coefficients_) a.add_term(unknown, coefficient);
    return a;
  }
  friend AffineMatrix operator-(const AffineMatrix& a, const AffineMatrix& b) { return a + -1.0 * b; }
  friend AffineMatrix operator*(double factor, AffineMatrix a) {
    a.constant_ *= factor;
    for (auto& [unknown, coefficient] : a.coefficients_) coefficient *= factor;
    return a;
  }
  friend AffineMatrix operator*(const Eigen::MatrixXd& left, const AffineMatrix& a) {
    assert(left.cols() == a.rows());
    AffineMatrix result(Eigen::MatrixXd(left.lazyProduct(a.constant_)));
    for (const auto& [unknown, coefficient] : a.coefficients_)
      result.add_term(unknown, left.lazyProduct(coefficient));
    return result;
  }

 private:
  Eigen::MatrixXd constant_;
  std::map<int, Eigen::MatrixXd> coefficients_;
};

/// The symmetric matrix with these blocks on and below its diagonal (row i has i + 1 blocks); those above are
/// mirrored. An empty AffineMatrix below the diagonal is a block of zeros.
AffineMatrix symmetric_blocks(const std::vector<std::vector<AffineMatrix>>& lower);

/// minimise cost' x subject to inequalities >= 0 (positive semidefinite).
class LmiProblem {
 public:
  /// New unknowns as a 1x1, a full or a symmetric matrix.
  AffineMatrix scalar() { return matrix(1, 1); }
  AffineMatrix matrix(Eigen::Index rows, Eigen::Index columns);
  AffineMatrix symmetric(Eigen::Index size);

  void require_positive(AffineMatrix inequality) { inequalities_.push_back(std::move(inequality)); }
  /// A new unknown t, added to every inequality as t I and bounded below by -1.
  AffineMatrix relax();
  /// `objective` is 1x1; its constant does not matter.
  void minimise(const AffineMatrix& objective) { objective_ = objective; }

  int unknown_count() const { return unknown_count_; }
  const std::vector<AffineMatrix>& inequalities() const { return inequalities_; }
  const AffineMatrix& objective() const { return objective_; }

  /// Violation of the inequalities at `unknowns`: the largest -(least eigenvalue) / max(1, largest
  /// eigenvalue) of all blocks. It is 0 or less if all inequalities hold.
  double violation(const Eigen::VectorXd& unknowns) const;

 private:
  int unknown_count_ = 0;
  std::vector<AffineMatrix> inequalities_;
  AffineMatrix objective_{1, 1};
};

}  // namespace strainwave
