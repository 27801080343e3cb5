// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether a rendered image shows what is predicted, pixel by pixel.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "mvo/sim.hpp"
#include "statistics.hpp"

namespace mvo::test {

/// The point [m] that a pixel of the left image sees at a depth [m].
inline Eigen::Vector3d pointAt(const StereoCamera& camera, int column, int row, double depth) {
  return {(column - camera.cu) / camera.fu * depth, (row - camera.cv) / camera.fv * depth, depth};
}

/// What 90 % of the pixels of `from` in a region differ at most from where a point transform and a
/// projection say they are in `to`.
template <typename Target>
double photometricError(const sim::RenderedFrame& from, const cv::Mat& to, const cv::Mat& region,
                        const StereoCamera& camera, Target target) {
  cv::Mat columns(region.size(), CV_32FC1, cv::Scalar(-1));
  cv::Mat rows = columns.clone();
  for (int v = 0; v < region.rows; ++v) {
    for (int u = 0; u < region.cols; ++u) {
      if (region.at<std::uint8_t>(v, u) == 0) continue;
      const Eigen::Vector2d p = target(pointAt(camera, u, v, from.depth.at<float>(v, u)));
      columns.at<float>(v, u) = static_cast<float>(p.x());
      rows.at<float>(v, u) = static_cast<float>(p.y());
    }
  }
  cv::Mat warped;
  cv::remap(to, warped, columns, rows, cv::INTER_LINEAR);
  std::vector<int> differences;
  for (int v = 0; v < region.rows; ++v) {
    for (int u = 0; u < region.cols; ++u) {
      if (region.at<std::uint8_t>(v, u) == 0) continue;
      differences.push_back(
          std::abs(warped.at<std::uint8_t>(v, u) - from.left.at<std::uint8_t>(v, u)));
    }
  }
  EXPECT_GT(differences.size(), 1000U);
  const std::size_t ninth = differences.size() * 9 / 10;
  return valueOfRank(std::move(differences), ninth);
}

}  // namespace mvo::test
