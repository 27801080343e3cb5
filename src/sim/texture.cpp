// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/texture.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace mvo::sim {
namespace {

bool isPowerOfTwo(int n) { return n > 0 && (n & (n - 1)) == 0; }

}  // namespace

Texture makeTexture(const cv::Mat& bitmap) {
  if (bitmap.type() != CV_8UC1 || !isPowerOfTwo(bitmap.cols) || !isPowerOfTwo(bitmap.rows)) {
    throw std::invalid_argument("a texture must be 8UC1 with sides that are powers of two");
  }
  Texture texture;
  texture.levels.push_back(bitmap.clone());
  while (texture.levels.back().cols > 1 || texture.levels.back().rows > 1) {
    const cv::Mat& fine = texture.levels.back();
    cv::Mat coarse;
    cv::resize(fine, coarse, {std::max(1, fine.cols / 2), std::max(1, fine.rows / 2)}, 0, 0,
               cv::INTER_AREA);
    texture.levels.push_back(coarse);
  }
  return texture;
}

}  // namespace mvo::sim
