// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/keypoints.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <opencv2/imgproc.hpp>

namespace mvo {

namespace {

constexpr int kPeak = 5;                             // side of the neighbourhood a point rules [px]
constexpr std::array<int, 4> kPlaces{-5, -2, 2, 5};  // where gradients are sampled [px]
constexpr int kBorder = 7;                           // of the image, without points [px]
constexpr double kSmoothing = 1.2;  // standard deviation, of the image that is filtered [px]
constexpr double kFixedPoint = 32;  // steps of a grey level
// Half the sum of the filters' absolute weights: responses in grey levels.
constexpr float kBlobGain = 64;
constexpr float kCornerGain = 18;

// Where the quadric through a peak's 3x3 neighbourhood has its extremum, relative to the pixel.
cv::Point2f subpixelPeak(const cv::Mat& response, int u, int v) {
  const auto at = [&](int du, int dv) {
    return static_cast<float>(response.at<std::int16_t>(v + dv, u + du));
  };
  const float centre = at(0, 0);
  const Eigen::Vector2f gradient(0.5F * (at(1, 0) - at(-1, 0)), 0.5F * (at(0, 1) - at(0, -1)));
  const float cross = 0.25F * (at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1));
  Eigen::Matrix2f hessian;
  hessian << at(1, 0) - 2 * centre + at(-1, 0), cross, cross, at(0, 1) - 2 * centre + at(0, -1);
  if (!(hessian.determinant() > 0)) return {0, 0};
  const Eigen::Vector2f offset = -(hessian.inverse() * gradient).cwiseMax(-0.5F).cwiseMin(0.5F);
  return {offset.x(), offset.y()};
}

Descriptor descriptorAt(const cv::Mat& along_u, const cv::Mat& along_v, int u, int v) {
  Descriptor descriptor;
  std::size_t i = 0;
  for (const int dv : kPlaces) {
    const uchar* g_u = along_u.ptr<uchar>(v + dv) + u;
    const uchar* g_v = along_v.ptr<uchar>(v + dv) + u;
    for (const int du : kPlaces) {
      descriptor[i++] = g_u[du];
      descriptor[i++] = g_v[du];
    }
  }
  return descriptor;
}

}  // namespace

KeypointSet findKeypoints(const cv::Mat& image, const FrontendOptions& options) {
  cv::Mat along_u;
  cv::Mat along_v;
  cv::Sobel(image, along_u, CV_8U, 1, 0, 3, 0.25, 128);
  cv::Sobel(image, along_v, CV_8U, 0, 1, 3, 0.25, 128);
  cv::Mat blob;
  cv::Mat corner;
  // Smoothed in fixed point: a broad, quiet peak is found again more exactly.
  cv::Mat smooth;
  image.convertTo(smooth, CV_16S, kFixedPoint);
  cv::GaussianBlur(smooth, smooth, {}, kSmoothing);
  cv::Laplacian(smooth, blob, CV_16S, 5, -1 / kFixedPoint);
  cv::Sobel(smooth, corner, CV_16S, 1, 1, 5, 1 / kFixedPoint);
  const cv::Mat neighbourhood = cv::Mat::ones(kPeak, kPeak, CV_8U);

  KeypointSet set;
  for (std::size_t kind = 0; kind < set.size(); ++kind) {
    const bool is_blob = kind < 2;
    cv::Mat response = is_blob ? blob : corner;
    if (kind % 2 == 1) response = -response;
    const float gain = is_blob ? kBlobGain : kCornerGain;
    const auto least = static_cast<float>(options.min_contrast) * gain;
    cv::Mat peak;
    cv::dilate(response, peak, neighbourhood);
    Keypoints& points = set[kind];
    for (int v = 0; v < image.rows; ++v) {
      points.rows.push_back(points.size());
      if (v < kBorder || v >= image.rows - kBorder) continue;
      const auto* r = response.ptr<std::int16_t>(v);
      const auto* m = peak.ptr<std::int16_t>(v);
      for (int u = kBorder; u < image.cols - kBorder; ++u) {
        if (r[u] != m[u] || !(r[u] > least)) continue;
        const cv::Point2f offset = subpixelPeak(response, u, v);
        points.positions.emplace_back(static_cast<float>(u) + offset.x,
                                      static_cast<float>(v) + offset.y);
        points.contrast.push_back(r[u] / gain);
        points.descriptors.push_back(descriptorAt(along_u, along_v, u, v));
      }
    }
    points.rows.push_back(points.size());
  }
  return set;
}

}  // namespace mvo
