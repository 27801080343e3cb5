// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/frontend/reference_patch.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace mvo {

namespace {

constexpr float kWidth = 0.42F;       // Gaussian's standard deviation relative to half the side
constexpr float kMinNorm = 2.0F;      // grey levels
constexpr float kMaxStep = 3.0F;      // farther than this is another point [px]
constexpr float kConverged = 0.005F;  // [px]
constexpr float kAffineRidge =
    0.02F;  // keeps the affine part quiet where the texture does not show it, relative

// Bilinear samples of the warped grid; false if any lies outside.
bool sample(const cv::Mat& image, const PatchWarp& warp, int side, Eigen::ArrayXf& out) {
  const int half = side / 2;
  const Eigen::Vector2f reach =
      (warp.A.cwiseAbs() * Eigen::Vector2f::Constant(static_cast<float>(half))).array() + 1.0F;
  if (!(warp.t.x() - reach.x() >= 0) || !(warp.t.y() - reach.y() >= 0) ||
      !(warp.t.x() + reach.x() < static_cast<float>(image.cols - 1)) ||
      !(warp.t.y() + reach.y() < static_cast<float>(image.rows - 1)))
    return false;
  const auto step = static_cast<std::ptrdiff_t>(image.step);
  float* value = out.data();
  for (int y = -half; y <= half; ++y) {
    float u =
        warp.t.x() + warp.A(0, 1) * static_cast<float>(y) - warp.A(0, 0) * static_cast<float>(half);
    float v =
        warp.t.y() + warp.A(1, 1) * static_cast<float>(y) - warp.A(1, 0) * static_cast<float>(half);
    for (int x = 0; x < side; ++x, u += warp.A(0, 0), v += warp.A(1, 0)) {
      const int iu = static_cast<int>(u);
      const int iv = static_cast<int>(v);
      const float a = u - static_cast<float>(iu);
      const float b = v - static_cast<float>(iv);
      const uchar* p = image.data + iv * step + iu;
      const auto p00 = static_cast<float>(p[0]);
      const auto p10 = static_cast<float>(p[step]);
      const float top = p00 + a * (static_cast<float>(p[1]) - p00);
      const float bottom = p10 + a * (static_cast<float>(p[step + 1]) - p10);
      *value++ = top + b * (bottom - top);
    }
  }
  return true;
}

}  // namespace

std::optional<ReferencePatch> ReferencePatch::take(const cv::Mat& image,
                                                   const Eigen::Vector2f& centre, int side) {
  // One pixel more on every side, for the derivatives.
  const int wide = side + 2;
  Eigen::ArrayXf values(wide * wide);
  if (!sample(image, {Eigen::Matrix2f::Identity(), centre}, wide, values)) return std::nullopt;

  ReferencePatch patch;
  patch.side_ = side;
  const int n = side * side;
  const int half = side / 2;
  patch.weight_.resize(n);
  patch.values_.resize(n);
  patch.descent_.resize(6, n);
  const float width = kWidth * static_cast<float>(side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int i = y * side + x;
      const float* p = values.data() + (y + 1) * wide + x + 1;
      const auto dx = static_cast<float>(x - half);
      const auto dy = static_cast<float>(y - half);
      const float gx = 0.5F * (p[1] - p[-1]);
      const float gy = 0.5F * (p[wide] - p[-wide]);
      patch.values_(i) = *p;
      patch.weight_(i) = std::exp(-0.5F * (dx * dx + dy * dy) / (width * width));
      patch.descent_.col(i) << gx, gy, gx * dx, gx * dy, gy * dx, gy * dy;
    }
  patch.weight_ /= patch.weight_.sum();
  patch.values_ -= (patch.weight_ * patch.values_).sum();
  patch.norm_ = std::sqrt((patch.weight_ * patch.values_.square()).sum());
  if (!(patch.norm_ > kMinNorm)) return std::nullopt;

  // Gain and offset are projected out of the steepest-descent images once, instead of being
  // estimated at every step.
  const Eigen::ArrayXf unit = patch.values_ / patch.norm_;
  for (int r = 0; r < 6; ++r) {
    Eigen::ArrayXf row = patch.descent_.row(r).transpose().array();
    row -= (patch.weight_ * row).sum();
    row -= (patch.weight_ * row * unit).sum() * unit;
    patch.descent_.row(r) = row.matrix().transpose();
  }
  const Eigen::Matrix<float, 6, Eigen::Dynamic> weighted =
      patch.descent_ * patch.weight_.matrix().asDiagonal();
  Eigen::Matrix<float, 6, 6> H = weighted * patch.descent_.transpose();
  const float ridge = kAffineRidge * (H(0, 0) + H(1, 1)) * width * width;
  H.diagonal().tail<4>().array() += ridge;
  H.diagonal().head<2>().array() += 1e-3F;
  patch.inverse_hessian_ = H.inverse();
  patch.descent_ = weighted;
  return patch;
}

std::optional<PatchAlignment> ReferencePatch::align(const cv::Mat& image, const PatchWarp& start,
                                                    int iterations) const {
  PatchAlignment result;
  result.warp = start;
  Eigen::ArrayXf values(side_ * side_);
  for (int i = 0; i < iterations; ++i) {
    if (!sample(image, result.warp, side_, values)) return std::nullopt;
    values -= (weight_ * values).sum();
    const float norm = std::sqrt((weight_ * values.square()).sum());
    if (!(norm > 0.5F * kMinNorm)) return std::nullopt;
    result.correlation = (weight_ * values * values_).sum() / (norm * norm_);
    const Eigen::Matrix<float, 6, 1> step =
        inverse_hessian_ * (descent_ * (values * (norm_ / norm)).matrix());
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
