// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kernels/landmark.hpp"

#include <algorithm>
#include <cmath>

#include "kernels/lanes.hpp"

namespace mvo {

namespace {

// A product of (1 + s) above this is replaced by its logarithm.
constexpr double kLargestProduct = 1e100;

MVO_INLINE Doubles maxOf(Doubles a, double b) {
  const Doubles limit = {b, b, b, b};
  return a > limit ? a : limit;
}

// What residuals and their derivatives share at four places.
struct Gains {
  Doubles u, v, d;   // gain / depth
  Doubles by_depth;  // 1 / depth, 0 where the depth is held at its least
};

MVO_INLINE Gains gainsAt(const LandmarkMeasurements& of, Doubles depth) {
  const Doubles inverse = 1.0 / maxOf(depth, kLeastDepth);
  const Doubles zero = {};
  return {of.gain[0] * inverse, of.gain[1] * inverse, of.gain[2] * inverse,
          depth > kLeastDepth + zero ? inverse : zero};
}

// |e|^2 where there is a measurement and 0 elsewhere.
template <typename M>
MVO_INLINE Doubles squareOf(const MeasurementBlock& block, Doubles u, Doubles v, Doubles d) {
  return load(block.seen.data()) * fused<M>(d, d, fused<M>(u, u, v * v));
}

// (1 + excess)(1 + s) - 1, without losing a small s.
template <typename M>
MVO_INLINE void addSquares(Doubles square, Doubles s, ResidualSums& sums) {
  store(sums.squares.data(), load(sums.squares.data()) + square);
  const Doubles excess = load(sums.excess.data());
  const Doubles product = fused<M>(s, 1.0 + excess, excess);
  store(sums.excess.data(), product);
  const double largest =
      std::max(std::max(product[0], product[1]), std::max(product[2], product[3]));
  if (largest > kLargestProduct) {
    sums.logarithms = sums.totalLogarithms();
    sums.excess.fill(0);
  }
}

template <typename M>
MVO_INLINE void addResidualsLanes(const LandmarkMeasurements& of, const double* poses,
                                  std::size_t stride, ResidualSums& result) {
  ResidualSums sums = result;
  const double rho = of.m[2];
  double p[3];
  for (std::size_t r = 0; r < 3; ++r)
    p[r] = fused<M>(of.B[6 + r], rho, of.origin[r] + of.B[r] * of.m[0] + of.B[3 + r] * of.m[1]);
  for (std::size_t b = 0; b < of.count; ++b) {
    const double* at = poses + kDoubles * b;
    const auto C = [&](std::size_t row, std::size_t column)
                       MVO_KERNEL { return load(at + (3 * column + row) * stride); };
    const auto t = [&](std::size_t row) MVO_KERNEL { return load(at + (9 + row) * stride); };
    const auto carried = [&](std::size_t row) MVO_KERNEL {  // C p + rho t
      const Doubles first = fused<M>(C(row, 0), p[0], C(row, 1) * p[1]);
      return fused<M>(t(row), rho, fused<M>(C(row, 2), p[2], first));
    };
    const MeasurementBlock& block = of.blocks[b];
    const Gains gain = gainsAt(of, carried(2));
    const Doubles u = fused<M>(-gain.u, carried(0), load(block.u.data()));
    const Doubles v = fused<M>(-gain.v, carried(1), load(block.v.data()));
    const Doubles d = fused<M>(-gain.d, rho, load(block.d.data()));
    const Doubles square = squareOf<M>(block, u, v, d);
    addSquares<M>(square, of.inverse_square_scale * square, sums);
  }
  result = sums;
}

// A landmark in the cameras of four poses: A = C B + t e_3^T, q = C origin + A m.
struct Carried {
  Doubles A[3][3];
  Doubles q[3];
};

template <typename M>
MVO_INLINE Carried carry(const LandmarkMeasurements& of, const double* pose, std::size_t stride) {
  Carried to;
  for (std::size_t r = 0; r < 3; ++r) {
    const Doubles c0 = load(pose + r * stride);
    const Doubles c1 = load(pose + (3 + r) * stride);
    const Doubles c2 = load(pose + (6 + r) * stride);
    for (std::size_t c = 0; c < 3; ++c)
      to.A[r][c] = fused<M>(c2, of.B[3 * c + 2], fused<M>(c0, of.B[3 * c], c1 * of.B[3 * c + 1]));
    to.A[r][2] += load(pose + (9 + r) * stride);
    to.q[r] = fused<M>(c2, of.origin[2], fused<M>(c0, of.origin[0], c1 * of.origin[1]));
    for (std::size_t c = 0; c < 3; ++c) to.q[r] = fused<M>(to.A[r][c], of.m[c], to.q[r]);
  }
  return to;
}

// Residuals of four poses with their weights and derivatives.
struct Linearized {
  Doubles e[3];
  Doubles weight;
  Doubles J[3][3];  // w.r.t. the landmark
  // Rows of that w.r.t. the pose without their zeros: u at columns 0, 2 ... 5, v at 1, 2 ... 5, d
  // at 2 ... 4.
  Doubles u[5], v[5], d[4];
};

template <typename M>
MVO_INLINE Linearized linearize(const LandmarkMeasurements& of, const Carried& at,
                                const MeasurementBlock& block, ResidualSums& sums) {
  const auto& [A, q] = at;
  const double rho = of.m[2];
  const Gains gain = gainsAt(of, q[2]);
  const Doubles seen_u = gain.u * q[0];
  const Doubles seen_v = gain.v * q[1];
  Linearized out;
  out.e[0] = load(block.u.data()) - seen_u;
  out.e[1] = load(block.v.data()) - seen_v;
  out.e[2] = fused<M>(-gain.d, rho, load(block.d.data()));
  const Doubles square = squareOf<M>(block, out.e[0], out.e[1], out.e[2]);
  const Doubles s = of.inverse_square_scale * square;
  addSquares<M>(square, s, sums);
  out.weight = load(block.seen.data()) / (1.0 + s);

  // D = de/dq: (-gain.u, 0, Du), (0, -gain.v, Dv), (0, 0, Dd).
  const Doubles Du = seen_u * gain.by_depth;
  const Doubles Dv = seen_v * gain.by_depth;
  const Doubles Dd = gain.d * rho * gain.by_depth;
  // J = D A - (0, 0, gain.d)^T e_3^T.
  for (std::size_t c = 0; c < 3; ++c) {
    out.J[0][c] = fused<M>(Du, A[2][c], -(gain.u * A[0][c]));
    out.J[1][c] = fused<M>(Dv, A[2][c], -(gain.v * A[1][c]));
    out.J[2][c] = c < 2 ? Dd * A[2][c] : fused<M>(Dd, A[2][2], -gain.d);
  }
  // J_pose = D [rho 1, -q^].
  out.u[0] = -rho * gain.u;
  out.u[1] = rho * Du;
  out.u[2] = Du * q[1];
  out.u[3] = fused<M>(-gain.u, q[2], -(Du * q[0]));
  out.u[4] = gain.u * q[1];
  out.v[0] = -rho * gain.v;
  out.v[1] = rho * Dv;
  out.v[2] = fused<M>(gain.v, q[2], Dv * q[1]);
  out.v[3] = -Dv * q[0];
  out.v[4] = -gain.v * q[0];
  out.d[0] = rho * Dd;
  out.d[1] = Dd * q[1];
  out.d[2] = -Dd * q[0];
  out.d[3] = Doubles{};
  return out;
}

// Adds the landmark's own part of the normal equations.
template <typename M>
MVO_INLINE void addOwnPart(const Linearized& of, Doubles (&V)[6], Doubles (&g)[3]) {
  for (std::size_t r = 0; r < 3; ++r) {
    std::size_t i = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      const Doubles weighted = of.weight * of.J[r][row];
      for (std::size_t c = 0; c <= row; ++c, ++i) V[i] = fused<M>(weighted, of.J[r][c], V[i]);
      g[row] = fused<M>(weighted, of.e[r], g[row]);
    }
  }
}

// The weighted derivatives w.r.t. the pose, and what they are multiplied with.
struct WeightedRows {
  Doubles u[5], v[5], d[4];

  MVO_INLINE explicit WeightedRows(const Linearized& of) {
    for (std::size_t i = 0; i < 5; ++i) {
      u[i] = of.weight * of.u[i];
      v[i] = of.weight * of.v[i];
    }
    for (std::size_t i = 0; i < 4; ++i) d[i] = of.weight * of.d[i];
  }
  // With column i + 1 of the pose, i > 0.
  template <typename M>
  MVO_INLINE Doubles product(std::size_t i, Doubles by_u, Doubles by_v, Doubles by_d) const {
    const Doubles h = fused<M>(u[i], by_u, v[i] * by_v);
    return i < 4 ? fused<M>(d[i - 1], by_d, h) : h;
  }
};

// Adds the poses' part: H and g.
template <typename M>
MVO_INLINE void addPosePart(const Linearized& of, const WeightedRows& w, double* to,
                            std::size_t stride) {
  const auto add = [&](std::size_t row, Doubles a, Doubles b) MVO_KERNEL {
    double* place = to + row * stride;
    store(place, fused<M>(a, b, load(place)));
  };
  add(0, w.u[0], of.u[0]);  // row 1, column 0 is zero
  add(2, w.v[0], of.v[0]);
  for (std::size_t i = 1; i < 5; ++i) {  // row i + 1 of H
    const std::size_t row = (i + 1) * (i + 2) / 2;
    add(row, w.u[i], of.u[0]);
    add(row + 1, w.v[i], of.v[0]);
    for (std::size_t j = 1; j <= i; ++j) {
      double* place = to + (row + 1 + j) * stride;
      store(place, load(place) + w.product<M>(i, of.u[j], of.v[j], of.d[j - 1]));
    }
  }
  add(21, w.u[0], of.e[0]);
  add(22, w.v[0], of.e[1]);
  for (std::size_t i = 1; i < 5; ++i) {
    double* place = to + (22 + i) * stride;
    store(place, load(place) + w.product<M>(i, of.e[0], of.e[1], of.e[2]));
  }
}

// Writes W.
template <typename M>
MVO_INLINE void writeCoupling(const Linearized& of, const WeightedRows& w, double* W) {
  for (std::size_t c = 0; c < 3; ++c) {
    store(W + kDoubles * c, w.u[0] * of.J[0][c]);
    store(W + kDoubles * (3 + c), w.v[0] * of.J[1][c]);
    for (std::size_t i = 1; i < 5; ++i)
      store(W + kDoubles * (3 * (i + 1) + c), w.product<M>(i, of.J[0][c], of.J[1][c], of.J[2][c]));
  }
}

template <typename M>
MVO_INLINE LandmarkTerms linearizeLandmarkLanes(const LandmarkMeasurements& of, const double* poses,
                                                std::size_t stride, double* pose_sums,
                                                double* coupling, ResidualSums& result) {
  ResidualSums sums = result;
  Doubles V[6] = {};
  Doubles g[3] = {};
  for (std::size_t b = 0; b < of.count; ++b) {
    const Carried at = carry<M>(of, poses + kDoubles * b, stride);
    const Linearized block = linearize<M>(of, at, of.blocks[b], sums);
    addOwnPart<M>(block, V, g);
    const WeightedRows weighted(block);
    addPosePart<M>(block, weighted, pose_sums + kDoubles * b, stride);
    writeCoupling<M>(block, weighted, coupling + kCouplingPerBlock * b);
  }
  result = sums;
  LandmarkTerms out;
  for (std::size_t i = 0; i < 6; ++i) out.V[i] = sum(V[i]);
  for (std::size_t i = 0; i < 3; ++i) out.g[i] = sum(g[i]);
  return out;
}

template <typename M>
MVO_INLINE void writeFactorLanes(const double* coupling, std::size_t blocks,
                                 const std::array<double, 6>& K, double* U, std::size_t stride) {
  const auto put = [](double* to, double a, double b) MVO_KERNEL {
    *reinterpret_cast<HalfDoubles*>(to) = HalfDoubles{a, b};
  };
  for (std::size_t b = 0; b < blocks; ++b) {
    const double* W = coupling + kCouplingPerBlock * b;
    double* to = U + 6 * kDoubles * b;
    for (std::size_t row = 0; row < 6; row += 2) {
      Doubles columns[2][3];
      for (std::size_t i = 0; i < 2; ++i) {
        const double* w = W + 3 * kDoubles * (row + i);
        const Doubles w0 = load(w);
        const Doubles w1 = load(w + kDoubles);
        const Doubles w2 = load(w + 2 * kDoubles);
        columns[i][0] = w0 * K[0];
        columns[i][1] = fused<M>(w0, K[1], w1 * K[2]);
        columns[i][2] = fused<M>(w2, K[5], fused<M>(w0, K[3], w1 * K[4]));
      }
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < kDoubles; ++lane)
          put(to + c * stride + 6 * lane + row, columns[0][c][lane], columns[1][c][lane]);
    }
  }
}

}  // namespace

double ResidualSums::totalSquares() const {
  return (squares[0] + squares[2]) + (squares[1] + squares[3]);
}

double ResidualSums::totalLogarithms() const {
  double total = logarithms;
  for (const double e : excess) total += std::log1p(e);
  return total;
}

void addResiduals(const LandmarkMeasurements& of, const double* poses, std::size_t stride,
                  ResidualSums& sums) {
  onThisMachine([&](auto machine)
                    MVO_KERNEL { addResidualsLanes<decltype(machine)>(of, poses, stride, sums); });
}

LandmarkTerms linearizeLandmark(const LandmarkMeasurements& of, const double* poses,
                                std::size_t stride, double* pose_sums, double* coupling,
                                ResidualSums& sums) {
  return onThisMachine([&](auto machine) MVO_KERNEL {
    return linearizeLandmarkLanes<decltype(machine)>(of, poses, stride, pose_sums, coupling, sums);
  });
}

void writeFactor(const double* coupling, std::size_t blocks, const std::array<double, 6>& K,
                 double* U, std::size_t stride) {
  onThisMachine([&](auto machine) MVO_KERNEL {
    writeFactorLanes<decltype(machine)>(coupling, blocks, K, U, stride);
  });
}

}  // namespace mvo
