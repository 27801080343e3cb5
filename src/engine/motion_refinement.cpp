// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/motion_refinement.hpp"

#include <optional>

#include "mvo/se3.hpp"

namespace mvo {

namespace {

// A = L D L^T, in place; none if A is not positive definite.
std::optional<Vector6d> solve(LinkEquations::Equations equations) {
  const auto at = [&equations](int row, int column) -> double& {
    return equations[row * (row + 1) / 2 + column];
  };
  double* b = equations.data() + LinkEquations::kTriangle;
  for (int column = 0; column < 6; ++column) {
    at(column, column) += 1e-9;
    double scaled[6];
    for (int m = 0; m < column; ++m) scaled[m] = at(column, m) * at(m, m);
    for (int row = column; row < 6; ++row)
      for (int m = 0; m < column; ++m) at(row, column) -= at(row, m) * scaled[m];
    const double pivot = at(column, column);
    if (!(pivot > 0)) return std::nullopt;
    for (int row = column + 1; row < 6; ++row) at(row, column) /= pivot;
  }
  for (int row = 0; row < 6; ++row)
    for (int m = 0; m < row; ++m) b[row] -= at(row, m) * b[m];
  for (int row = 5; row >= 0; --row) {
    b[row] /= at(row, row);
    for (int m = row + 1; m < 6; ++m) b[row] -= at(m, row) * b[m];
  }
  return Vector6d(b);
}

}  // namespace

Eigen::Isometry3d MotionFit::refine(Eigen::Isometry3d T_b_a, double scale, int iterations) const {
  for (int i = 0; i < iterations; ++i) {
    const std::optional<Vector6d> step = solve(equations_.at(T_b_a, scale));
    if (!step || !step->allFinite() || step->norm() > 10) break;
    T_b_a = exp(*step) * T_b_a;
    if (step->norm() < 1e-9) break;
  }
  return T_b_a;
}

}  // namespace mvo
