// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Points that are found again in every image by themselves: blobs and corners, each with a short
// description of its surroundings.
#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "mvo/options.hpp"

namespace mvo {

/// Gradients along u and v at 16 places around a point.
using Descriptor = std::array<std::uint8_t, 32>;

/// Points of one kind, row by row from the top and from left to right within a row.
struct Keypoints {
  std::vector<cv::Point2f> positions;  ///< sub-pixel [px]
  std::vector<float> contrast;         ///< of the filter's response [grey levels]
  std::vector<Descriptor> descriptors;
  std::vector<int> rows;  ///< index of the first point of each pixel row, and the number of points

  int size() const { return static_cast<int>(positions.size()); }
};

/// Bright blobs, dark blobs, corners that are bright down-right and those that are dark there: a
/// point is only ever matched with its own kind.
using KeypointSet = std::array<Keypoints, 4>;

/// All points of an image with at least options.min_contrast.
KeypointSet findKeypoints(const cv::Mat& image, const FrontendOptions& options);

}  // namespace mvo
