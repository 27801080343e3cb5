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

// q = C p + rho t in the cameras of four poses.
struct Places {
  Doubles x, y, z;
};

// e of four measurements, |e|^2 where there is one and 0 elsewhere, and what its derivatives share.
struct Residuals {
  Doubles u, v, d;
  Doubles square;
  Doubles by_u, by_v, by_d;  // gain / depth
  Doubles by_depth;          // 1 / depth, 0 where the depth is held at its least
};

MVO_INLINE Residuals residualsAt(const LandmarkMeasurements& of, const Places& q,
                                 const MeasurementBlock& block) {
  Residuals out;
  const Doubles inverse = 1.0 / maxOf(q.z, kLeastDepth);
  const Doubles zero = {};
  out.by_depth = q.z > kLeastDepth + zero ? inverse : zero;
  out.by_u = of.gain[0] * inverse;
  out.by_v = of.gain[1] * inverse;
  out.by_d = of.gain[2] * inverse;
  out.u = load(block.u.data()) - out.by_u * q.x;
  out.v = load(block.v.data()) - out.by_v * q.y;
  out.d = load(block.d.data()) - out.by_d * of.m[2];
  out.square = load(block.seen.data()) * (out.u * out.u + out.v * out.v + out.d * out.d);
  return out;
}

// (1 + excess)(1 + s) - 1, without losing a small s.
MVO_INLINE void addSquares(Doubles square, Doubles s, ResidualSums& sums) {
  store(sums.squares.data(), load(sums.squares.data()) + square);
  const Doubles excess = load(sums.excess.data());
  const Doubles product = excess + s * (1.0 + excess);
  store(sums.excess.data(), product);
  const double largest =
      std::max(std::max(product[0], product[1]), std::max(product[2], product[3]));
  if (largest > kLargestProduct) {
    sums.logarithms = sums.totalLogarithms();
    sums.excess.fill(0);
  }
}

MVO_INLINE void addResidualsLanes(const LandmarkMeasurements& of, const double* poses,
                                  std::size_t stride, ResidualSums& result) {
  ResidualSums sums = result;
  std::array<double, 3> p = of.origin;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t r = 0; r < 3; ++r) p[r] += of.B[3 * c + r] * of.m[c];
  for (std::size_t b = 0; b < of.count; ++b) {
    const double* at = poses + kDoubles * b;
    const auto C = [&](std::size_t row, std::size_t column) __attribute__((always_inline)) {
      return load(at + (3 * column + row) * stride);
    };
    const auto t = [&](std::size_t row) __attribute__((always_inline)) {
      return load(at + (9 + row) * stride);
    };
    const double rho = of.m[2];
    const Places q = {C(0, 0) * p[0] + C(0, 1) * p[1] + C(0, 2) * p[2] + rho * t(0),
                      C(1, 0) * p[0] + C(1, 1) * p[1] + C(1, 2) * p[2] + rho * t(1),
                      C(2, 0) * p[0] + C(2, 1) * p[1] + C(2, 2) * p[2] + rho * t(2)};
    const Residuals e = residualsAt(of, q, of.blocks[b]);
    addSquares(e.square, of.inverse_square_scale * e.square, sums);
  }
  result = sums;
}

MVO_INLINE LandmarkTerms linearizeLandmarkLanes(const LandmarkMeasurements& of, const double* poses,
                                                std::size_t stride, double* pose_sums,
                                                double* coupling, ResidualSums& result) {
  ResidualSums sums = result;
  Doubles V[6] = {};
  Doubles g[3] = {};
  const double rho = of.m[2];
  for (std::size_t b = 0; b < of.count; ++b) {
    const double* at = poses + kDoubles * b;
    const auto pose = [&](std::size_t row) __attribute__((always_inline)) {
      return load(at + row * stride);
    };
    // A = C B + t e_3^T, q = C origin + A m.
    Doubles A[3][3];
    Doubles q[3];
    for (std::size_t r = 0; r < 3; ++r) {
      const Doubles c0 = pose(r);
      const Doubles c1 = pose(3 + r);
      const Doubles c2 = pose(6 + r);
      for (std::size_t c = 0; c < 3; ++c)
        A[r][c] = c0 * of.B[3 * c] + c1 * of.B[3 * c + 1] + c2 * of.B[3 * c + 2];
      A[r][2] += pose(9 + r);
      q[r] = c0 * of.origin[0] + c1 * of.origin[1] + c2 * of.origin[2] + A[r][0] * of.m[0] +
             A[r][1] * of.m[1] + A[r][2] * rho;
    }
    const Residuals e = residualsAt(of, {q[0], q[1], q[2]}, of.blocks[b]);
    const Doubles s = of.inverse_square_scale * e.square;
    addSquares(e.square, s, sums);
    const Doubles weight = load(of.blocks[b].seen.data()) / (1.0 + s);

    // D = de/dq: (-by_u, 0, Du), (0, -by_v, Dv), (0, 0, Dd).
    const Doubles Du = e.by_u * q[0] * e.by_depth;
    const Doubles Dv = e.by_v * q[1] * e.by_depth;
    const Doubles Dd = e.by_d * rho * e.by_depth;

    // J_landmark = D A - (0, 0, by_d)^T e_3^T.
    Doubles M[3][3];
    for (std::size_t c = 0; c < 3; ++c) {
      M[0][c] = Du * A[2][c] - e.by_u * A[0][c];
      M[1][c] = Dv * A[2][c] - e.by_v * A[1][c];
      M[2][c] = Dd * A[2][c];
    }
    M[2][2] -= e.by_d;
    for (std::size_t r = 0; r < 3; ++r) {
      const Doubles residual = r == 0 ? e.u : r == 1 ? e.v : e.d;
      const Doubles m0 = weight * M[r][0];
      const Doubles m1 = weight * M[r][1];
      const Doubles m2 = weight * M[r][2];
      V[0] += m0 * M[r][0];
      V[1] += m1 * M[r][0];
      V[2] += m1 * M[r][1];
      V[3] += m2 * M[r][0];
      V[4] += m2 * M[r][1];
      V[5] += m2 * M[r][2];
      g[0] += m0 * residual;
      g[1] += m1 * residual;
      g[2] += m2 * residual;
    }

    // J_pose = D [rho 1, -q^]: its rows without their zeros, the first two at columns 0 (1), 2 ...
    // 5, the last at 2 ... 4.
    const Doubles Ju[5] = {-rho * e.by_u, rho * Du, Du * q[1], -e.by_u * q[2] - Du * q[0],
                           e.by_u * q[1]};
    const Doubles Jv[5] = {-rho * e.by_v, rho * Dv, e.by_v * q[2] + Dv * q[1], -Dv * q[0],
                           -e.by_v * q[0]};
    const Doubles Jd[3] = {rho * Dd, Dd * q[1], -Dd * q[0]};
    Doubles wu[5];
    Doubles wv[5];
    Doubles wd[3];
    for (std::size_t i = 0; i < 5; ++i) {
      wu[i] = weight * Ju[i];
      wv[i] = weight * Jv[i];
    }
    for (std::size_t i = 0; i < 3; ++i) wd[i] = weight * Jd[i];

    double* to = pose_sums + kDoubles * b;
    const auto add = [&](std::size_t row, Doubles value) __attribute__((always_inline)) {
      double* place = to + row * stride;
      store(place, load(place) + value);
    };
    add(0, wu[0] * Ju[0]);  // row 1, column 0 is zero
    add(2, wv[0] * Jv[0]);
    for (std::size_t i = 1; i < 5; ++i) {  // row i + 1 of H
      const std::size_t row = (i + 1) * (i + 2) / 2;
      add(row, wu[i] * Ju[0]);
      add(row + 1, wv[i] * Jv[0]);
      for (std::size_t j = 1; j <= i; ++j) {
        Doubles h = wu[i] * Ju[j] + wv[i] * Jv[j];
        if (i < 4) h += wd[i - 1] * Jd[j - 1];
        add(row + 1 + j, h);
      }
    }
    add(21, wu[0] * e.u);
    add(22, wv[0] * e.v);
    for (std::size_t i = 1; i < 5; ++i) {
      Doubles h = wu[i] * e.u + wv[i] * e.v;
      if (i < 4) h += wd[i - 1] * e.d;
      add(22 + i, h);
    }

    double* W = coupling + kCouplingPerBlock * b;
    for (std::size_t c = 0; c < 3; ++c) {
      store(W + kDoubles * c, wu[0] * M[0][c]);
      store(W + kDoubles * (3 + c), wv[0] * M[1][c]);
      for (std::size_t i = 1; i < 5; ++i) {
        Doubles w = wu[i] * M[0][c] + wv[i] * M[1][c];
        if (i < 4) w += wd[i - 1] * M[2][c];
        store(W + kDoubles * (3 * (i + 1) + c), w);
      }
    }
  }
  result = sums;
  LandmarkTerms out;
  for (std::size_t i = 0; i < 6; ++i) out.V[i] = sum(V[i]);
  for (std::size_t i = 0; i < 3; ++i) out.g[i] = sum(g[i]);
  return out;
}

MVO_INLINE void writeFactorLanes(const double* coupling, std::size_t blocks,
                                 const std::array<double, 6>& K, double* U, std::size_t stride) {
  const auto put = [](double* to, double a, double b) __attribute__((always_inline)) {
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
        columns[i][1] = w0 * K[1] + w1 * K[2];
        columns[i][2] = w0 * K[3] + w1 * K[4] + w2 * K[5];
      }
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < kDoubles; ++lane)
          put(to + c * stride + 6 * lane + row, columns[0][c][lane], columns[1][c][lane]);
    }
  }
}

#ifdef MVO_HAS_AVX2_KERNELS
MVO_AVX2 void addResidualsAvx2(const LandmarkMeasurements& of, const double* poses,
                               std::size_t stride, ResidualSums& sums) {
  addResidualsLanes(of, poses, stride, sums);
}
MVO_AVX2 LandmarkTerms linearizeLandmarkAvx2(const LandmarkMeasurements& of, const double* poses,
                                             std::size_t stride, double* pose_sums,
                                             double* coupling, ResidualSums& sums) {
  return linearizeLandmarkLanes(of, poses, stride, pose_sums, coupling, sums);
}
MVO_AVX2 void writeFactorAvx2(const double* coupling, std::size_t blocks,
                              const std::array<double, 6>& K, double* U, std::size_t stride) {
  writeFactorLanes(coupling, blocks, K, U, stride);
}
#endif

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
#ifdef MVO_HAS_AVX2_KERNELS
  if (usesAvx2()) return addResidualsAvx2(of, poses, stride, sums);
#endif
  addResidualsLanes(of, poses, stride, sums);
}

LandmarkTerms linearizeLandmark(const LandmarkMeasurements& of, const double* poses,
                                std::size_t stride, double* pose_sums, double* coupling,
                                ResidualSums& sums) {
#ifdef MVO_HAS_AVX2_KERNELS
  if (usesAvx2()) return linearizeLandmarkAvx2(of, poses, stride, pose_sums, coupling, sums);
#endif
  return linearizeLandmarkLanes(of, poses, stride, pose_sums, coupling, sums);
}

void writeFactor(const double* coupling, std::size_t blocks, const std::array<double, 6>& K,
                 double* U, std::size_t stride) {
#ifdef MVO_HAS_AVX2_KERNELS
  if (usesAvx2()) return writeFactorAvx2(coupling, blocks, K, U, stride);
#endif
  writeFactorLanes(coupling, blocks, K, U, stride);
}

}  // namespace mvo
