// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F's passes over the measurements of one landmark, four poses at a time: the residuals' cost,
// their part of the normal equations, and the landmark's part of the Schur complement's factor.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "kernels/lanes.hpp"

namespace mvo {

/// Depth below which a point counts as lying there, in units of its anchor's depth: a point that
/// passes behind a camera keeps a finite, large residual.
constexpr double kLeastDepth = 0.01;

/// Whitened measurements of one landmark in four consecutive poses; seen is 1, or 0 where there is
/// none.
struct MeasurementBlock {
  std::array<double, kDoubles> u{};
  std::array<double, kDoubles> v{};
  std::array<double, kDoubles> d{};
  std::array<double, kDoubles> seen{};
};

/// Rows of numbers, one number per pose, with room for a block that begins at the last pose.
class PoseTable {
 public:
  /// Zeros.
  void reset(std::size_t rows, std::size_t poses) {
    stride_ = poses + kDoubles;
    values_.assign(rows * stride_, 0.0);
  }
  std::size_t stride() const { return stride_; }
  double* at(std::size_t pose) { return values_.data() + pose; }
  const double* at(std::size_t pose) const { return values_.data() + pose; }
  double& operator()(std::size_t row, std::size_t pose) { return values_[row * stride_ + pose]; }
  double operator()(std::size_t row, std::size_t pose) const {
    return values_[row * stride_ + pose];
  }

 private:
  std::size_t stride_ = 0;
  std::vector<double> values_;
};

constexpr std::size_t kPoseRows = 12;  ///< C column by column, then t
constexpr std::size_t kSumRows = 27;   ///< lower triangle of H row by row, then g

/// A landmark where it is, and what was measured of it.
struct LandmarkMeasurements {
  std::array<double, 3> gain;    ///< as in BundleProblem
  double inverse_square_scale;   ///< of the robust loss [1]; 0 = squares
  std::array<double, 9> B;       ///< of its chart, column by column
  std::array<double, 3> origin;  ///< of its chart
  std::array<double, 3> m;       ///< (a, b, rho)
  const MeasurementBlock* blocks;
  std::size_t count;  ///< of blocks
};

/// Sums over residuals: of squares, and of log(1 + s) of the squares in units of the robust
/// scale's, kept as one product per lane, less one, because a logarithm costs more than a residual.
struct ResidualSums {
  std::array<double, kDoubles> squares{};
  std::array<double, kDoubles> excess{};
  double logarithms = 0;
  double totalSquares() const;
  double totalLogarithms() const;
};

/// A landmark's own part of the normal equations.
struct LandmarkTerms {
  std::array<double, 6> V;  ///< lower triangle row by row
  std::array<double, 3> g;
};

constexpr std::size_t kCouplingPerBlock = std::size_t{18} * kDoubles;

/// Adds a landmark's residuals to `sums`. `poses` is at the landmark's first pose.
void addResiduals(const LandmarkMeasurements& of, const double* poses, std::size_t stride,
                  ResidualSums& sums);

/// The same, and adds its part of H and g to `pose_sums` (at its first pose, same stride as
/// `poses`), writes its couplings W (6x3 row by row, each in lanes of four poses) block by block.
LandmarkTerms linearizeLandmark(const LandmarkMeasurements& of, const double* poses,
                                std::size_t stride, double* pose_sums, double* coupling,
                                ResidualSums& sums);

/// U = W K^T for the lower triangular K (row by row), as three columns of `stride` numbers; six
/// rows per pose, also of the poses that fill the last block.
void writeFactor(const double* coupling, std::size_t blocks, const std::array<double, 6>& K,
                 double* U, std::size_t stride);

}  // namespace mvo
