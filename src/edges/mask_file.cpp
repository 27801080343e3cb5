// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/mask_file.hpp"

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace mvo_ros {

namespace {

std::string text(const cv::Size& size) {
  return std::to_string(size.width) + "x" + std::to_string(size.height);
}

}  // namespace

Mask readMask(const std::string& path) {
  const std::string source = "mask " + path;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw std::runtime_error(source + ": there is no such file");
  const cv::Mat image = cv::imread(path, cv::IMREAD_GRAYSCALE);
  if (image.empty()) throw std::runtime_error(source + ": cannot be read as an image");
  if (cv::countNonZero(image) == 0)
    throw std::runtime_error(source + ": is 0 everywhere, which leaves out the whole image");
  return {image, source};
}

void requireSize(const Mask& mask, const cv::Size& left) {
  if (mask.image.empty() || mask.image.size() == left) return;
  throw std::runtime_error(mask.source + ": has " + text(mask.image.size()) +
                           " pixels, but the left image has " + text(left));
}

}  // namespace mvo_ros
