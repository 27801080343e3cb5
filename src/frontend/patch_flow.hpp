// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pyramidal Lucas-Kanade of one point at a time (inverse compositional, translation only): what
// OpenCV's calcOpticalFlowPyrLK does, at a fraction of its time for small patches, and a patch that
// has been taken once is looked for in several images.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "kernels/patch.hpp"

namespace mvo {

/// An 8-bit image and `levels` halvings (fewer if they get smaller than a patch), each within a
/// mirrored border that patches around any of its pixels can reach into.
std::vector<cv::Mat> buildPaddedPyramid(const cv::Mat& image, int side, int levels);

/// A patch of a pyramid and the memory to follow it. Not for several threads at once.
class PatchFlow {
 public:
  /// `side` is odd [px].
  explicit PatchFlow(int side) : side_(side) {}

  /// Takes the patches around p [px] of the levels 0 .. `levels`.
  void take(const std::vector<cv::Mat>& pyramid, const cv::Point2f& p, int levels);
  /// Moves q [px], which says where to start, to where the patch is; false if that is outside or
  /// the patch has no texture. Starts at the coarsest level taken.
  bool follow(const std::vector<cv::Mat>& pyramid, cv::Point2f& q) const;

 private:
  struct Level {
    FlowPatch patch;
    bool usable = false;
    std::vector<float> memory;
  };
  // Steps until one is `small` [px].
  bool descend(const cv::Mat& image, const FlowPatch& patch, float small, cv::Point2f& q) const;

  int side_;
  int levels_ = -1;  // the coarsest
  std::vector<Level> patches_;
  std::vector<float> room_;
};

}  // namespace mvo
