// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dense operations that the batch of III-F spends its time in, on column-major memory with
// room for whole tiles. They use AVX2 where the machine has it, chosen at run time, so the library
// needs no machine flags.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace mvo {

/// Rows and columns that the kernels may touch beyond a matrix' own; what is there must be finite.
constexpr Eigen::Index kTilePadding = 12;

/// S -= U U^T, lower triangle (entries of the upper one within a tile of the diagonal change too).
/// S points to n + padding square with stride `stride_s`, U to n + padding rows, those beyond n
/// zero, and as many columns as ends[]: column c is zero from row ends[c] on (not rising with c).
void subtractGram(double* S, Eigen::Index stride_s, const double* U, Eigen::Index stride_u,
                  Eigen::Index n, const std::vector<Eigen::Index>& ends);

/// b -= U y. U has n rows and k columns.
void subtractProduct(double* b, const double* U, Eigen::Index stride_u, Eigen::Index n,
                     Eigen::Index k, const double* y);

/// y += U^T x.
void addTransposedProduct(double* y, const double* U, Eigen::Index stride_u, Eigen::Index n,
                          Eigen::Index k, const double* x);

/// S = L L^T of the leading n square, in place in the lower triangle; S has n + padding rows and
/// columns, rows beyond n zero. reach[c] says up to which row (exclusive, not falling) column c and
/// those before it are not zero; what lies beyond is not read. False if a pivot is not positive.
bool choleskyInPlace(Eigen::MatrixXd& S, const std::vector<Eigen::Index>& reach);

/// x of L L^T x = b, for a factor that may be larger than b.
Eigen::VectorXd choleskySolve(const Eigen::MatrixXd& L, Eigen::VectorXd b);

}  // namespace mvo
