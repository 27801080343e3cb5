// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/photometry.hpp"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "sim/random.hpp"

namespace mvo::sim {
namespace {

// Quantiles of the standard normal distribution.
const std::vector<float>& normalTable() {
  static const std::vector<float> table = [] {
    constexpr int kSize = 4096;
    const boost::math::normal normal;
    std::vector<float> values;
    values.reserve(kSize);
    for (int i = 0; i < kSize; ++i) {
      values.push_back(static_cast<float>(boost::math::quantile(normal, (i + 0.5) / kSize)));
    }
    return values;
  }();
  return table;
}

cv::Mat throughJpeg(const cv::Mat& image, int quality) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality});
  return cv::imdecode(bytes, image.channels() == 1 ? cv::IMREAD_GRAYSCALE : cv::IMREAD_COLOR);
}

}  // namespace

cv::Mat expose(const cv::Mat& image, double gain, double noise, std::uint64_t seed) {
  const std::vector<float>& normal = normalTable();
  cv::Mat bytes(image.size(), CV_MAKETYPE(CV_8U, image.channels()));
  Random random(seed);
  std::uint64_t bits = 0;
  int left = 0;
  for (int row = 0; row < image.rows; ++row) {
    const auto* values = image.ptr<float>(row);
    auto* out = bytes.ptr<std::uint8_t>(row);
    for (int i = 0; i < image.cols * image.channels(); ++i) {
      if (left == 0) {
        bits = random.next();
        left = 5;
      }
      const float deviation = normal[bits & 4095];
      bits >>= 12;
      --left;
      const float value =
          static_cast<float>(gain) * values[i] + static_cast<float>(noise) * deviation;
      out[i] = static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
    }
  }
  return bytes;
}

double exposureOf(const Scene& scene, int frame, double row_time) {
  const Imperfections& imperfections = scene.options.imperfections;
  const double lamps = 1 + imperfections.flicker * std::sin(2 * M_PI * imperfections.flicker_hz *
                                                            (scene.time(frame) + row_time));
  return lamps * (frame >= imperfections.exposure_frame ? imperfections.exposure : 1);
}

cv::Mat develop(cv::Mat light, const Scene& scene, int frame, const Eye& eye) {
  const SceneOptions& options = scene.options;
  const Imperfections& imperfections = options.imperfections;
  if (imperfections.flicker != 0 || imperfections.exposure != 1) {
    for (int row = 0; row < light.rows; ++row)
      light.row(row) *= exposureOf(scene, frame, eye.rowTime(row));
  }
  if (imperfections.defocus > 0) {
    cv::GaussianBlur(light, light, {}, imperfections.defocus, 0, cv::BORDER_REPLICATE);
  }
  const std::uint64_t seed =
      Random({scene.seed, static_cast<std::uint64_t>(frame), static_cast<std::uint64_t>(eye.side)})
          .next();
  const double gain = eye.side == Side::kRight ? options.gain : 1.0;
  const cv::Mat image = expose(light, gain, options.noise, seed);
  return imperfections.jpeg > 0 ? throughJpeg(image, imperfections.jpeg) : image;
}

}  // namespace mvo::sim
