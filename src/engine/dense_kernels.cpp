// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "dense_kernels.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace mvo {

namespace {

using Eigen::Index;

// Four doubles anywhere in memory; the compiler makes of them what the target has.
using Lanes = double __attribute__((vector_size(32), aligned(8), may_alias));
constexpr Index kRows = 8;     // of a tile: two Lanes
constexpr Index kColumns = 4;  // of a tile: together eight accumulators
static_assert(kRows <= kTilePadding && kColumns <= kTilePadding);

__attribute__((always_inline)) inline void subtractGramTiles(double* S, Index stride_s,
                                                             const double* U, Index stride_u,
                                                             Index n, Index k) {
  for (Index column = 0; column < n; column += kColumns)
    for (Index row = column; row < n; row += kRows) {
      Lanes sum[kColumns][2] = {};
      for (Index m = 0; m < k; ++m) {
        const double* u = U + m * stride_u;
        const Lanes upper = *reinterpret_cast<const Lanes*>(u + row);
        const Lanes lower = *reinterpret_cast<const Lanes*>(u + row + 4);
        for (Index c = 0; c < kColumns; ++c) {
          sum[c][0] += upper * u[column + c];
          sum[c][1] += lower * u[column + c];
        }
      }
      for (Index c = 0; c < kColumns; ++c) {
        double* s = S + (column + c) * stride_s + row;
        *reinterpret_cast<Lanes*>(s) -= sum[c][0];
        *reinterpret_cast<Lanes*>(s + 4) -= sum[c][1];
      }
    }
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma"))) void subtractGramAvx2(double* S, Index stride_s,
                                                          const double* U, Index stride_u, Index n,
                                                          Index k) {
  subtractGramTiles(S, stride_s, U, stride_u, n, k);
}

bool hasAvx2() {
  static const bool has = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  return has;
}
#endif

}  // namespace

void subtractGram(double* S, Index stride_s, const double* U, Index stride_u, Index n, Index k) {
#if defined(__x86_64__)
  if (hasAvx2()) return subtractGramAvx2(S, stride_s, U, stride_u, n, k);
#endif
  subtractGramTiles(S, stride_s, U, stride_u, n, k);
}

bool choleskyInPlace(Eigen::MatrixXd& S, Index n) {
  constexpr Index panel_width = 24;
  Eigen::MatrixXd panel(n + kTilePadding, panel_width);
  for (Index column = 0; column < n; column += panel_width) {
    const Index width = std::min(panel_width, n - column);
    auto diagonal = S.block(column, column, width, width);
    const Eigen::LLT<Eigen::MatrixXd> llt(diagonal);
    if (llt.info() != Eigen::Success) return false;
    diagonal.triangularView<Eigen::Lower>() = llt.matrixL();
    const Index below = column + width;
    const Index rows = n - below;
    if (rows == 0) break;
    auto rest = S.block(below, column, rows, width);
    for (Index c = 0; c < width; ++c) {
      for (Index m = 0; m < c; ++m) rest.col(c) -= diagonal(c, m) * rest.col(m);
      rest.col(c) /= diagonal(c, c);
    }
    panel.topLeftCorner(rows, width) = rest;
    panel.block(rows, 0, kTilePadding, width).setZero();
    subtractGram(&S(below, below), S.outerStride(), panel.data(), panel.outerStride(), rows, width);
  }
  return true;
}

Eigen::VectorXd choleskySolve(const Eigen::MatrixXd& L, Eigen::VectorXd b) {
  const Index n = b.size();
  for (Index c = 0; c < n; ++c) {
    b(c) /= L(c, c);
    b.tail(n - c - 1) -= b(c) * L.col(c).segment(c + 1, n - c - 1);
  }
  for (Index c = n - 1; c >= 0; --c)
    b(c) = (b(c) - L.col(c).segment(c + 1, n - c - 1).dot(b.tail(n - c - 1))) / L(c, c);
  return b;
}

}  // namespace mvo
