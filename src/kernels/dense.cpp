// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/dense.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

using Eigen::Index;

constexpr Index kRows = 12;    // of a tile: three Doubles
constexpr Index kColumns = 4;  // of a tile: together twelve accumulators
constexpr Index kPanel = 24;   // columns factorised at a time
constexpr Index kStrip = 12;   // rows of a panel solved at a time
static_assert(kRows <= kTilePadding && kColumns <= kTilePadding && kStrip <= kTilePadding);

// One tile of S -= U U^T; S and U point to its first row, `across` to its first column's row of U.
template <typename M>
MVO_INLINE void subtractTile(double* S, Index stride_s, const double* U, const double* across,
                             Index stride_u, Index k) {
  Doubles sum[kColumns][3] = {};
  for (Index m = 0; m < k; ++m, U += stride_u, across += stride_u) {
    const Doubles a = load(U);
    const Doubles b = load(U + 4);
    const Doubles c = load(U + 8);
    for (Index i = 0; i < kColumns; ++i) {
      sum[i][0] = fused<M>(a, across[i], sum[i][0]);
      sum[i][1] = fused<M>(b, across[i], sum[i][1]);
      sum[i][2] = fused<M>(c, across[i], sum[i][2]);
    }
  }
  for (Index i = 0; i < kColumns; ++i)
    for (Index part = 0; part < 3; ++part) {
      double* s = S + i * stride_s + 4 * part;
      store(s, load(s) - sum[i][part]);
    }
}

template <typename M>
MVO_INLINE void subtractGramTiles(double* S, Index stride_s, const double* U, Index stride_u,
                                  Index n, const Index* ends, Index k) {
  for (Index column = 0; column < n; column += kColumns) {
    Index depth = k;
    for (Index row = column; row < n; row += kRows) {
      while (depth > 0 && ends[depth - 1] <= row) --depth;
      if (depth == 0) break;
      subtractTile<M>(S + column * stride_s + row, stride_s, U + row, U + column, stride_u, depth);
    }
  }
}

template <typename M>
MVO_INLINE void subtractProductLanes(double* b, const double* U, Index stride_u, Index n, Index k,
                                     const double* y) {
  Index row = 0;
  for (; row + kDoubles <= n; row += kDoubles) {
    Doubles sum = load(b + row);
    for (Index m = 0; m < k; ++m) sum = fused<M>(load(U + m * stride_u + row), -y[m], sum);
    store(b + row, sum);
  }
  for (; row < n; ++row)
    for (Index m = 0; m < k; ++m) b[row] = fused<M>(U[m * stride_u + row], -y[m], b[row]);
}

template <typename M>
MVO_INLINE void addTransposedProductLanes(double* y, const double* U, Index stride_u, Index n,
                                          Index k, const double* x) {
  for (Index m = 0; m < k; ++m) {
    const double* u = U + m * stride_u;
    Doubles even = {};
    Doubles odd = {};
    Index row = 0;
    for (; row + 2 * kDoubles <= n; row += 2 * kDoubles) {
      even = fused<M>(load(u + row), load(x + row), even);
      odd = fused<M>(load(u + row + kDoubles), load(x + row + kDoubles), odd);
    }
    double rest = 0;
    for (; row < n; ++row) rest += u[row] * x[row];
    y[m] += sum(even + odd) + rest;
  }
}

// The square on the diagonal.
template <typename M>
MVO_INLINE bool factorizeSquare(double* S, Index stride, Index width) {
  for (Index c = 0; c < width; ++c) {
    double* column = S + c * stride;
    for (Index m = 0; m < c; ++m) {
      const double* left = S + m * stride;
      const double minus = -left[c];
      for (Index r = c; r < width; ++r) column[r] = fused<M>(minus, left[r], column[r]);
    }
    if (!(column[c] > 0)) return false;
    const double pivot = std::sqrt(column[c]);
    column[c] = pivot;
    for (Index r = c + 1; r < width; ++r) column[r] /= pivot;
  }
  return true;
}

// P L^-T of the rows below a factorised square, in place, a strip of rows at a time.
template <typename M>
MVO_INLINE void solvePanel(double* P, const double* L, Index stride, Index rows, Index width) {
  for (Index row = 0; row < rows; row += kStrip)
    for (Index c = 0; c < width; ++c) {
      double* to = P + c * stride + row;
      Doubles x = load(to);
      Doubles y = load(to + 4);
      Doubles z = load(to + 8);
      for (Index m = 0; m < c; ++m) {
        const double minus = -L[m * stride + c];
        const double* left = P + m * stride + row;
        x = fused<M>(load(left), minus, x);
        y = fused<M>(load(left + 4), minus, y);
        z = fused<M>(load(left + 8), minus, z);
      }
      const double inverse = 1.0 / L[c * stride + c];
      store(to, x * inverse);
      store(to + 4, y * inverse);
      store(to + 8, z * inverse);
    }
}

template <typename M>
MVO_INLINE bool choleskyPanels(double* S, Index stride, const Index* reach, Index n) {
  for (Index column = 0; column < n; column += kPanel) {
    const Index width = std::min(kPanel, n - column);
    double* square = S + column * stride + column;
    if (!factorizeSquare<M>(square, stride, width)) return false;
    const Index rows = reach[column + width - 1] - column - width;
    if (rows <= 0) continue;
    solvePanel<M>(square + width, square, stride, rows, width);
    for (Index c = 0; c < rows; c += kColumns)
      for (Index r = c; r < rows; r += kRows)
        subtractTile<M>(square + (width + c) * stride + width + r, stride, square + width + r,
                        square + width + c, stride, width);
  }
  return true;
}

}  // namespace

void subtractGram(double* S, Index stride_s, const double* U, Index stride_u, Index n,
                  const std::vector<Index>& ends) {
  const auto k = static_cast<Index>(ends.size());
  onThisMachine([&](auto machine) MVO_KERNEL {
    return subtractGramTiles<decltype(machine)>(S, stride_s, U, stride_u, n, ends.data(), k);
  });
}

void subtractProduct(double* b, const double* U, Index stride_u, Index n, Index k,
                     const double* y) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return subtractProductLanes<decltype(machine)>(b, U, stride_u, n, k, y);
  });
}

void addTransposedProduct(double* y, const double* U, Index stride_u, Index n, Index k,
                          const double* x) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    return addTransposedProductLanes<decltype(machine)>(y, U, stride_u, n, k, x);
  });
}

bool choleskyInPlace(Eigen::MatrixXd& S, const std::vector<Index>& reach) {
  const auto n = static_cast<Index>(reach.size());
  return onThisMachine([&](auto machine) MVO_KERNEL {
    return choleskyPanels<decltype(machine)>(S.data(), S.outerStride(), reach.data(), n);
  });
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
