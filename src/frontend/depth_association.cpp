// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/depth_association.hpp"

#include <algorithm>
#include <cmath>

namespace mvo {

namespace {
constexpr double kMaxStep =
    0.03;  // a neighbourhood whose depth varies by more, relative, is an edge
constexpr double kNearer =
    0.05;  // a surface in the patch is another one if it is nearer by this...
constexpr double kDisparity = 0.6;  // ... and by this; what noise and far depths do not reach [px]

// Whether the patch around a point shows a surface in front of the point's: it is followed with
// that one's outline, which moves otherwise. Disparity is linear over a plane's image, so sums of
// opposite places do not see its slant.
bool showsNearerSurface(const cv::Mat& depth, int u, int v, double disparity,
                        const StereoCamera& camera, const FrontendOptions& options) {
  const int reach = options.patch / 2;
  const double fb = camera.fu * camera.baseline;
  const double step = std::max(kNearer * disparity, kDisparity);
  const auto at = [&](int du, int dv) {
    const int x = u + du;
    const int y = v + dv;
    if (x < 0 || y < 0 || x >= depth.cols || y >= depth.rows) return disparity;
    const float z = depth.at<float>(y, x);
    return std::isfinite(z) && z > 0 ? fb / z : disparity;
  };
  for (int dv = 0; dv <= reach; ++dv)
    for (int du = dv == 0 ? 1 : -reach; du <= reach; ++du)
      if (at(du, dv) + at(-du, -dv) - 2 * disparity > step) return true;
  return false;
}

}  // namespace

std::optional<double> virtualRightColumn(const cv::Mat& depth, const cv::Point2f& p,
                                         const StereoCamera& camera,
                                         const FrontendOptions& options) {
  const int u = static_cast<int>(std::floor(p.x));
  const int v = static_cast<int>(std::floor(p.y));
  if (u < 0 || v < 0 || u + 1 >= depth.cols || v + 1 >= depth.rows) return std::nullopt;
  const float z[4] = {depth.at<float>(v, u), depth.at<float>(v, u + 1), depth.at<float>(v + 1, u),
                      depth.at<float>(v + 1, u + 1)};
  for (const float value : z)
    if (!std::isfinite(value) || value < options.min_depth || value > options.max_depth)
      return std::nullopt;
  const auto [low, high] = std::minmax_element(z, z + 4);
  if (*high - *low > kMaxStep * *low) return std::nullopt;
  // Inverse depth is linear over a plane's image.
  const double a = p.x - u;
  const double b = p.y - v;
  const double w = (1 - b) * ((1 - a) / z[0] + a / z[1]) + b * ((1 - a) / z[2] + a / z[3]);
  if (showsNearerSurface(depth, cvRound(p.x), cvRound(p.y), camera.fu * camera.baseline * w, camera,
                         options))
    return std::nullopt;
  return camera.rightColumn(p.x, 1.0 / w);
}

}  // namespace mvo
