// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Sub-pixel positions without drift: every point is aligned with the patch it was born with, under
// an affine warp and a change of gain and offset, in both eyes. Frame-to-frame translation alone
// slides on bodies that turn.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace mvo {

/// Where a patch is in an image: the patch's coordinate x [px, from its centre] is seen at A x + t
/// [px].
struct PatchWarp {
  Eigen::Matrix2f A = Eigen::Matrix2f::Identity();
  Eigen::Vector2f t = Eigen::Vector2f::Zero();
};

/// Result of an alignment.
struct PatchAlignment {
  PatchWarp warp;
  float correlation = 0;  ///< weighted, normalised, in [-1, 1]
};

/// A patch with its steepest-descent images (inverse compositional Lucas-Kanade, Gaussian weights).
class ReferencePatch {
 public:
  /// None if the patch leaves the image or has no texture. `side` is odd [px].
  static std::optional<ReferencePatch> take(const cv::Mat& image, const Eigen::Vector2f& centre,
                                            int side);

  /// The warp that makes the image agree with the patch, from `start`; none if it diverges or
  /// leaves the image.
  std::optional<PatchAlignment> align(const cv::Mat& image, const PatchWarp& start,
                                      int iterations) const;

 private:
  int side_ = 0;
  float mean_ = 0;              // weighted
  float norm_ = 0;              // weighted norm of the zero-mean patch
  std::vector<float> values_;   // zero weighted mean
  std::vector<float> descent_;  // six rows, weighted, free of gain and offset
  Eigen::Matrix<float, 6, 6> inverse_hessian_ = Eigen::Matrix<float, 6, 6>::Zero();
};

}  // namespace mvo
