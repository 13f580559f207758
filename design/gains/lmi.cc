// SPDX-License-Identifier: BSD-3-Clause
#include "design/gains/lmi.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <limits>

namespace strainwave {

void AffineMatrix::add_term(int unknown, const Eigen::MatrixXd& coefficient) {
  const auto [entry, is_new] = coefficients_.try_emplace(unknown, coefficient);
  if (!is_new) entry->second += coefficient;
}

void AffineMatrix::add_block(Eigen::Index row, Eigen::Index column, const AffineMatrix& block) {
  constant_.block(row, column, block.rows(), block.cols()) += block.constant_;
  for (const auto& [unknown, coefficient] : block.coefficients_) {
    const auto entry = coefficients_.try_emplace(unknown, Eigen::MatrixXd::Zero(rows(), cols())).first;
    entry->second.block(row, column, block.rows(), block.cols()) += coefficient;
  }
}

AffineMatrix AffineMatrix::transpose() const {
  AffineMatrix result(Eigen::MatrixXd(constant_.transpose()));
  for (const auto& [unknown, coefficient] : coefficients_) result.add_term(unknown, coefficient.transpose());
  return result;
}

Eigen::MatrixXd AffineMatrix::at(const Eigen::VectorXd& unknowns) const {
  Eigen::MatrixXd value = constant_;
  for (const auto& [unknown, coefficient] : coefficients_) value += unknowns(unknown) * coefficient;
  return value;
}

AffineMatrix symmetric_blocks(const std::vector<std::vector<AffineMatrix>>& lower) {
  Eigen::Index size = 0;
  for (const auto& row : lower) size += row.back().rows();
  AffineMatrix whole(size, size);
  Eigen::Index row_offset = 0;
  for (std::size_t i = 0; i < lower.size(); ++i) {
    assert(lower[i].size() == i + 1);
    Eigen::Index column_offset = 0;
    for (std::size_t j = 0; j < i; ++j) {
      whole.add_block(row_offset, column_offset, lower[i][j]);
      whole.add_block(column_offset, row_offset, lower[i][j].transpose());
      column_offset += lower[j].back().rows();
    }
    whole.add_block(row_offset, row_offset, lower[i][i]);
    row_offset += lower[i][i].rows();
  }
  return whole;
}

AffineMatrix LmiProblem::matrix(Eigen::Index rows, Eigen::Index columns) {
  AffineMatrix result(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i) {
    for (Eigen::Index j = 0; j < columns; ++j) {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(rows, columns);
      unit(i, j) = 1.0;
      result.add_term(unknown_count_++, unit);
    }
  }
  return result;
}

AffineMatrix LmiProblem::symmetric(Eigen::Index size) {
  AffineMatrix result(size, size);
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = i; j < size; ++j) {
      Eigen::MatrixXd unit = Eigen::MatrixXd::Zero(size, size);
      unit(i, j) = unit(j, i) = 1.0;
      result.add_term(unknown_count_++, unit);
    }
  }
  return result;
}

AffineMatrix LmiProblem::relax() {
  AffineMatrix t = scalar();
  for (AffineMatrix& inequality : inequalities_) {
    for (Eigen::Index i = 0; i < inequality.rows(); ++i) inequality.add_block(i, i, t);
  }
  require_positive(t + AffineMatrix(Eigen::MatrixXd::Ones(1, 1)));
  return t;
}

double LmiProblem::violation(const Eigen::VectorXd& unknowns) const {
  double worst = -std::numeric_limits<double>::infinity();
  for (const AffineMatrix& inequality : inequalities_) {
    const Eigen::MatrixXd value = inequality.at(unknowns);
    if (!value.allFinite()) return std::numeric_limits<double>::infinity();
    const Eigen::VectorXd eigenvalues =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(value, Eigen::EigenvaluesOnly).eigenvalues();
    worst = std::max(worst, -eigenvalues(0) / std::max(1.0, eigenvalues(eigenvalues.size() - 1)));
  }
  return worst;
}

}  // namespace strainwave
