// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where an image has texture in two directions: what detection chooses from.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace mvo {

/// A pixel whose neighbourhood shows more texture than those around it.
struct CornerPeak {
  std::uint16_t u = 0;  ///< [px]
  std::uint16_t v = 0;
  float score =
      0;  ///< smallest eigenvalue of the gradient matrix of 5x5 px, mean [(grey level/px)^2]
};

/// All peaks of an 8-bit image, row by row.
std::vector<CornerPeak> findCornerPeaks(const cv::Mat& image);

}  // namespace mvo
