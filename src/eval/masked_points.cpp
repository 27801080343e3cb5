// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "eval/masked_points.hpp"

#include <cmath>

namespace mvo {

namespace {

constexpr int kBorder = 2;  // [px]

bool isNearBorder(const cv::Mat& mask, int u, int v) {
  const unsigned char value = mask.at<unsigned char>(v, u);
  for (int dv = -kBorder; dv <= kBorder; ++dv)
    for (int du = -kBorder; du <= kBorder; ++du) {
      if (du * du + dv * dv > kBorder * kBorder) continue;
      const int x = u + du;
      const int y = v + dv;
      if (x < 0 || y < 0 || x >= mask.cols || y >= mask.rows) continue;
      if (mask.at<unsigned char>(y, x) != value) return true;
    }
  return false;
}

}  // namespace

std::vector<MaskedPoint> maskPoints(const std::vector<LabelRow>& labels, const cv::Mat& mask) {
  std::vector<MaskedPoint> points;
  for (const LabelRow& label : labels) {
    const double u = std::round(label.u);
    const double v = std::round(label.v);
    if (!(u >= 0 && v >= 0 && u < mask.cols && v < mask.rows)) continue;
    const int x = static_cast<int>(u);
    const int y = static_cast<int>(v);
    points.push_back(
        {label.tracklet, label.motion_id, mask.at<unsigned char>(y, x), isNearBorder(mask, x, y)});
  }
  return points;
}

Association associate(const MaskedFrames& frames) {
  std::map<int, std::map<int, int>> votes;  // id -> body -> observations
  for (const auto& points : frames)
    for (const MaskedPoint& point : points)
      if (point.id >= 1) ++votes[point.id][point.body];
  Association association{{0, 0}};
  for (const auto& [id, bodies] : votes) {
    int best = 0;
    for (const auto& [body, count] : bodies)
      if (count > best) {
        best = count;
        association[id] = body;
      }
  }
  return association;
}

}  // namespace mvo
