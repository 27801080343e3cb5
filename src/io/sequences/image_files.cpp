// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequences/image_files.hpp"

#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace mvo {

namespace {

namespace fs = std::filesystem;

fs::path findImage(const fs::path& folder, const std::string& stem) {
  for (const char* extension : {".png", ".jpg", ".jpeg", ".pgm"})
    if (fs::exists(folder / (stem + extension))) return folder / (stem + extension);
  throw std::runtime_error("there is no image " + (folder / stem).string() + ".png");
}

cv::Mat decode(const fs::path& path, int flags) {
  cv::Mat image = cv::imread(path.string(), flags);
  if (image.empty()) throw std::runtime_error(path.string() + " is not a readable image");
  return image;
}

}  // namespace

std::string sixDigits(std::int64_t number) {
  char text[32];
  std::snprintf(text, sizeof(text), "%06lld", static_cast<long long>(number));
  return text;
}

cv::Mat readImage(const fs::path& folder, const std::string& stem, int flags,
                  const StereoCamera& camera) {
  const fs::path path = findImage(folder, stem);
  cv::Mat image = decode(path, flags);
  if (image.cols != camera.width || image.rows != camera.height)
    throw std::runtime_error(path.string() + " has " + std::to_string(image.cols) + "x" +
                             std::to_string(image.rows) + " pixels, the calibration says " +
                             std::to_string(camera.width) + "x" + std::to_string(camera.height));
  return image;
}

cv::Size imageSize(const fs::path& folder, const std::string& stem) {
  return decode(findImage(folder, stem), cv::IMREAD_UNCHANGED).size();
}

}  // namespace mvo
