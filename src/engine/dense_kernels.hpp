// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dense operations that the batch of III-F spends its time in, on column-major memory with
// room for whole tiles. They use AVX2 where the machine has it, chosen at run time, so the library
// needs no machine flags.
#pragma once

#include <Eigen/Core>

namespace mvo {

/// Rows and columns that the kernels may touch beyond a matrix' own; what is there must be finite.
constexpr Eigen::Index kTilePadding = 8;

/// S -= U U^T, lower triangle (entries of the upper one within a tile of the diagonal change too).
/// S points to n + padding square with stride `stride_s`, U to n + padding rows, those beyond n
/// zero, and k columns.
void subtractGram(double* S, Eigen::Index stride_s, const double* U, Eigen::Index stride_u,
                  Eigen::Index n, Eigen::Index k);

/// S = L L^T of the leading n square, in place in the lower triangle; S has n + padding rows and
/// columns. False if a pivot is not positive.
bool choleskyInPlace(Eigen::MatrixXd& S, Eigen::Index n);

/// x of L L^T x = b, for a factor that may be larger than b.
Eigen::VectorXd choleskySolve(const Eigen::MatrixXd& L, Eigen::VectorXd b);

}  // namespace mvo
