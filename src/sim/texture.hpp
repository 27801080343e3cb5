// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Grey bitmaps with their mipmaps, so that a surface looks the same from every distance.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace mvo::sim {

/// A bitmap that repeats in both directions and its halved versions.
struct Texture {
  std::vector<cv::Mat> levels;  ///< 8UC1, continuous; level l is 2^-l of the size of level 0

  int width() const { return levels.front().cols; }
  int height() const { return levels.front().rows; }
};

/// Builds the mipmaps. Throws std::invalid_argument unless the bitmap is 8UC1 and its sides are
/// powers of two.
Texture makeTexture(const cv::Mat& bitmap);

}  // namespace mvo::sim
