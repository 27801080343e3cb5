// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Small images whose contents are known.
#pragma once

#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace mvo::test_support {

/// Smooth random texture of high contrast; a seed gives the same bytes everywhere.
inline cv::Mat randomTexture(const cv::Size& size, std::uint64_t seed, double contrast = 127) {
  cv::RNG random(seed);
  cv::Mat noise(size, CV_32F);
  random.fill(noise, cv::RNG::UNIFORM, -1.0, 1.0);
  cv::GaussianBlur(noise, noise, {}, 1.5, 1.5, cv::BORDER_REFLECT);
  double low = 0;
  double high = 0;
  cv::minMaxLoc(noise, &low, &high);
  cv::Mat texture;
  noise.convertTo(texture, CV_8U, contrast / std::max(high, -low), 128);
  return texture;
}

/// The image moved by whole pixels; what comes in is mirrored.
inline cv::Mat translated(const cv::Mat& image, int du, int dv) {
  cv::Mat moved;
  const cv::Matx23d shift(1, 0, du, 0, 1, dv);
  cv::warpAffine(image, moved, shift, image.size(), cv::INTER_NEAREST, cv::BORDER_REFLECT);
  return moved;
}

/// A tile side by side until the image is full.
inline cv::Mat repeated(const cv::Mat& tile, const cv::Size& size) {
  cv::Mat image;
  cv::repeat(tile, size.height / tile.rows + 1, size.width / tile.cols + 1, image);
  return image(cv::Rect({0, 0}, size)).clone();
}

}  // namespace mvo::test_support
