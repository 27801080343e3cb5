// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/reference_patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/patch.hpp"

namespace mvo {

namespace {

constexpr float kWidth = 0.42F;       // Gaussian's standard deviation relative to half the side
constexpr float kMinNorm = 2.0F;      // grey levels
constexpr float kMaxStep = 3.0F;      // farther than this is another point [px]
constexpr float kConverged = 0.005F;  // a last step; what it leaves is far less [px]
// What the affine part costs that differs from where it started: s^2 / (n a^2) for noise of s = 2
// grey levels, n = 90 pixels' worth of weight and changes of a = 3 % from one frame to the next. A
// strong texture does not feel it; a weak one does not let noise turn the patch.
constexpr float kAffinePrior = 50.0F;

constexpr int kMaxSide = 51;

// Places and weights of the pixels of a patch, row by row; padded with pixels at its centre that
// have no weight.
struct Grid {
  int n = 0;
  std::vector<float> x;
  std::vector<float> y;
  std::vector<float> weight;  // sums to 1

  explicit Grid(int side) : n(paddedToLanes(side * side)), x(n, 0), y(n, 0), weight(n, 0) {
    const float width = kWidth * static_cast<float>(side);
    const int half = side / 2;
    for (int i = 0; i < side * side; ++i) {
      const int row = i / side;
      x[i] = static_cast<float>(i % side - half);
      y[i] = static_cast<float>(row - half);
      weight[i] = std::exp(-0.5F * (x[i] * x[i] + y[i] * y[i]) / (width * width));
    }
    const float sum = std::accumulate(weight.begin(), weight.end(), 0.0F);
    for (float& w : weight) w /= sum;
  }
};

const Grid& gridOf(int side) {
  static const std::vector<Grid> grids = [] {
    std::vector<Grid> all;
    for (int s = 1; s <= kMaxSide; s += 2) all.emplace_back(s);
    return all;
  }();
  return grids[static_cast<std::size_t>(side / 2)];
}

// Whether all of a warped patch can be sampled.
bool liesInside(const cv::Mat& image, const PatchWarp& warp, int side) {
  const int whole = side / 2;
  const auto half = static_cast<float>(whole);
  const Eigen::Vector2f reach =
      (warp.A.cwiseAbs() * Eigen::Vector2f::Constant(half)).array() + 1.0F;
  return warp.t.x() - reach.x() >= 0 && warp.t.y() - reach.y() >= 0 &&
         warp.t.x() + reach.x() < static_cast<float>(image.cols - 1) &&
         warp.t.y() + reach.y() < static_cast<float>(image.rows - 1);
}

// Bilinear, of an upright patch.
std::vector<float> samples(const cv::Mat& image, const Eigen::Vector2f& centre, int side) {
  const int whole = side / 2;
  const auto half = static_cast<float>(whole);
  const float u = centre.x() - half;
  const float v = centre.y() - half;
  const int iu = static_cast<int>(u);
  const int iv = static_cast<int>(v);
  const float a = u - static_cast<float>(iu);
  const float b = v - static_cast<float>(iv);
  std::vector<float> out(static_cast<std::size_t>(side) * side);
  for (int y = 0; y < side; ++y) {
    const uchar* above = image.ptr(iv + y) + iu;
    const uchar* below = image.ptr(iv + y + 1) + iu;
    for (int x = 0; x < side; ++x) {
      const float top =
          static_cast<float>(above[x]) + a * static_cast<float>(above[x + 1] - above[x]);
      const float bottom =
          static_cast<float>(below[x]) + a * static_cast<float>(below[x + 1] - below[x]);
      out[static_cast<std::size_t>(y) * side + x] = top + b * (bottom - top);
    }
  }
  return out;
}

}  // namespace

std::optional<ReferencePatch> ReferencePatch::take(const cv::Mat& image,
                                                   const Eigen::Vector2f& centre, int side) {
  // One pixel more on every side, for the derivatives.
  const int wide = side + 2;
  if (!liesInside(image, {Eigen::Matrix2f::Identity(), centre}, wide)) return std::nullopt;
  const std::vector<float> seen = samples(image, centre, wide);

  const Grid& grid = gridOf(side);
  ReferencePatch patch;
  patch.side_ = side;
  patch.values_.assign(static_cast<std::size_t>(grid.n), 0.0F);
  patch.descent_.assign(static_cast<std::size_t>(6) * grid.n, 0.0F);
  Eigen::Map<const Eigen::ArrayXf> weight(grid.weight.data(), grid.n);
  Eigen::Map<Eigen::ArrayXf> values(patch.values_.data(), grid.n);
  Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 6>> descent(patch.descent_.data(), grid.n, 6);
  for (int i = 0; i < side * side; ++i) {
    const float* p = seen.data() + (i / side + 1) * wide + i % side + 1;
    const float gx = 0.5F * (p[1] - p[-1]);
    const float gy = 0.5F * (p[wide] - p[-wide]);
    values(i) = *p;
    descent.row(i) << gx, gy, gx * grid.x[i], gx * grid.y[i], gy * grid.x[i], gy * grid.y[i];
  }
  patch.mean_ = (weight * values).sum();
  values -= patch.mean_;
  values.tail(grid.n - side * side).setZero();
  patch.norm_ = std::sqrt((weight * values.square()).sum());
  if (!(patch.norm_ > kMinNorm)) return std::nullopt;

  // Gain and offset are projected out of the steepest-descent images once, instead of being
  // estimated at every step.
  for (int r = 0; r < 6; ++r) {
    auto row = descent.col(r).array();
    row -= (weight * row).sum();
    row -= (weight * row * values).sum() / (patch.norm_ * patch.norm_) * values;
  }
  const Eigen::Matrix<float, Eigen::Dynamic, 6> weighted = weight.matrix().asDiagonal() * descent;
  Eigen::Matrix<float, 6, 6> H = weighted.transpose() * descent;
  H.diagonal().tail<4>().array() += kAffinePrior;
  H.diagonal().head<2>().array() += 1e-3F;
  patch.inverse_hessian_ = H.inverse();
  descent = weighted;
  return patch;
}

std::optional<PatchAlignment> ReferencePatch::align(const cv::Mat& image, const PatchWarp& start,
                                                    int iterations) const {
  const Grid& grid = gridOf(side_);
  const AffinePatch patch{grid.n,         grid.x.data(),   grid.y.data(), grid.weight.data(),
                          values_.data(), descent_.data(), mean_};
  const GreyImage grey{image.data, static_cast<std::ptrdiff_t>(image.step)};
  PatchAlignment result;
  result.warp = start;
  const Eigen::Matrix2f start_inverse = start.A.inverse();
  for (int i = 0; i < iterations; ++i) {
    if (!liesInside(image, result.warp, side_)) return std::nullopt;
    const Eigen::Matrix2f& W = result.warp.A;
    const Eigen::Vector2f& t = result.warp.t;
    const AffineSums sums =
        affineSums(grey, {W(0, 0), W(0, 1), W(1, 0), W(1, 1), t.x(), t.y()}, patch);
    const float norm = std::sqrt(std::max(0.0F, sums.square - sums.mean * sums.mean));
    if (!(norm > 0.5F * kMinNorm)) return std::nullopt;
    result.correlation = sums.product / (norm * norm_);
    Eigen::Matrix<float, 6, 1> slope =
        norm_ / norm * Eigen::Map<const Eigen::Matrix<float, 6, 1>>(sums.descent);
    const Eigen::Matrix2f change = start_inverse * result.warp.A - Eigen::Matrix2f::Identity();
    slope.tail<4>() +=
        kAffinePrior * Eigen::Vector4f(change(0, 0), change(0, 1), change(1, 0), change(1, 1));
    const Eigen::Matrix<float, 6, 1> step = inverse_hessian_ * slope;
    Eigen::Matrix2f D;
    D << 1 + step(2), step(3), step(4), 1 + step(5);
    // W <- W o dW^-1
    const Eigen::Matrix2f A = result.warp.A * D.inverse();
    const Eigen::Vector2f dt = A * step.head<2>();
    result.warp.A = A;
    result.warp.t -= dt;
    const float size = A.determinant();
    if (!(size > 0.2F && size < 5.0F) || !((result.warp.t - start.t).norm() < kMaxStep))
      return std::nullopt;
    if (dt.norm() < kConverged) break;
  }
  return result;
}

}  // namespace mvo
