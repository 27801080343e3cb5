// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/frontend/klt.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "mvo/frontend/depth_association.hpp"
#include "mvo/frontend/stereo_match.hpp"

namespace mvo {

namespace {

using Points = std::vector<cv::Point2f>;

constexpr double kMinEigenvalue = 1e-5;
constexpr int kNearbyLevels = 1;  // pyramid levels where the start is known to a few pixels

// Moves `to` (starts there) to where the patches around `from` are; false where tracking failed.
std::vector<uchar> follow(const std::vector<cv::Mat>& a, const std::vector<cv::Mat>& b,
                          const Points& from, Points& to, int levels,
                          const FrontendOptions& options) {
  std::vector<uchar> ok;
  if (from.empty()) return ok;
  const cv::TermCriteria stop(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
  cv::calcOpticalFlowPyrLK(a, b, from, to, ok, cv::noArray(),
                           cv::Size(options.patch, options.patch), levels, stop,
                           cv::OPTFLOW_USE_INITIAL_FLOW, kMinEigenvalue);
  return ok;
}

bool inside(const cv::Point2f& p, const cv::Mat& image, int border) {
  return p.x >= border && p.y >= border && p.x < static_cast<float>(image.cols - border) &&
         p.y < static_cast<float>(image.rows - border);
}

double distance(const cv::Point2f& a, const cv::Point2f& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

cv::Point2f leftOf(const Eigen::Vector3d& y) {
  return {static_cast<float>(y.x()), static_cast<float>(y.y())};
}
cv::Point2f rightOf(const Eigen::Vector3d& y) {
  return {static_cast<float>(y.z()), static_cast<float>(y.y())};
}

bool plausibleDisparity(double disparity, const FrontendOptions& options, int width) {
  return disparity >= options.min_disparity && disparity <= options.max_disparity * width;
}

// Keeps the entries whose flag is set, in all lists alike.
template <class... Lists>
void keep(const std::vector<uchar>& flags, Lists&... lists) {
  const auto filter = [&flags](auto& list) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < flags.size(); ++i)
      if (flags[i] != 0) list[n++] = list[i];
    list.resize(n);
  };
  (filter(lists), ...);
}

}  // namespace

std::vector<cv::Mat> buildPyramid(const cv::Mat& image, const FrontendOptions& options) {
  std::vector<cv::Mat> pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, cv::Size(options.patch, options.patch),
                              options.pyramid_levels, true);
  return pyramid;
}

std::vector<Feature> closeCircle(const FrameImages& from, const FrameImages& to,
                                 const std::vector<Feature>& features, const TrackingPrior& prior,
                                 const StereoCamera& camera, const FrontendOptions& options) {
  std::vector<Feature> known = features;
  std::vector<Eigen::Vector3d> expected;
  Points left_from;
  Points left_to;
  for (const Feature& f : known) {
    const auto it = prior.predicted.find(f.id);
    expected.push_back(it != prior.predicted.end() ? it->second : f.y);
    left_from.push_back(leftOf(f.y));
    left_to.push_back(leftOf(expected.back()));
  }

  // Over time, there and back.
  std::vector<uchar> ok =
      follow(from.left, to.left, left_from, left_to, options.pyramid_levels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    ok[i] = ok[i] != 0 && inside(left_to[i], to.left.front(), 2);
  keep(ok, known, expected, left_from, left_to);
  Points back = left_from;
  ok = follow(to.left, from.left, left_to, back, kNearbyLevels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    ok[i] = ok[i] != 0 && distance(back[i], left_from[i]) <= options.max_forward_backward;
  keep(ok, known, expected, left_from, left_to);

  std::vector<Feature> links;
  if (to.right.empty()) {  // RGB-D: the depth image closes the pair
    for (std::size_t i = 0; i < known.size(); ++i)
      if (const auto u_r = virtualRightColumn(to.depth, left_to[i], camera, options))
        links.push_back({known[i].id, {left_to[i].x, left_to[i].y, *u_r}});
    return links;
  }

  // Left-right, from the expected disparity.
  Points right_to;
  for (std::size_t i = 0; i < known.size(); ++i)
    right_to.emplace_back(left_to[i].x - static_cast<float>(expected[i].x() - expected[i].z()),
                          left_to[i].y);
  ok = follow(to.left, to.right, left_to, right_to, kNearbyLevels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    ok[i] = ok[i] != 0 && inside(right_to[i], to.right.front(), 2) &&
            std::abs(right_to[i].y - left_to[i].y) <= options.max_epipolar &&
            plausibleDisparity(left_to[i].x - right_to[i].x, options, camera.width);
  keep(ok, known, left_to, right_to);

  // The circle's fourth side.
  Points right_from;
  for (const Feature& f : known) right_from.push_back(rightOf(f.y));
  Points closing = right_to;
  ok = follow(from.right, to.right, right_from, closing, kNearbyLevels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    if (ok[i] != 0 && distance(closing[i], right_to[i]) <= options.max_circle)
      links.push_back({known[i].id, {left_to[i].x, left_to[i].y, right_to[i].x}});
  return links;
}

std::vector<Feature> matchNewPoints(const FrameImages& images,
                                    const std::vector<cv::Point2f>& corners,
                                    const StereoCamera& camera, const FrontendOptions& options) {
  std::vector<Feature> features;
  if (images.right.empty()) {
    for (const cv::Point2f& p : corners)
      if (const auto u_r = virtualRightColumn(images.depth, p, camera, options))
        features.push_back({0, {p.x, p.y, *u_r}});
    return features;
  }

  // Levels of the pyramid alternate with their derivatives; a first guess at half resolution is
  // enough for the rest.
  const int level = images.left.size() > 2 ? 1 : 0;
  const double scale = level == 1 ? 0.5 : 1.0;
  StereoSearch search;
  search.max_disparity = options.max_disparity * camera.width * scale;
  std::vector<double> disparity(corners.size(), -1);
  cv::parallel_for_(cv::Range(0, static_cast<int>(corners.size())), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      if (const auto d = searchDisparity(images.left[2 * level], images.right[2 * level],
                                         corners[i] * scale, search))
        disparity[i] = *d / scale;
  });
  Points left;
  Points right;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (disparity[i] < 0) continue;
    left.push_back(corners[i]);
    right.emplace_back(corners[i].x - static_cast<float>(disparity[i]), corners[i].y);
  }
  std::vector<uchar> ok = follow(images.left, images.right, left, right, kNearbyLevels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    ok[i] = ok[i] != 0 && inside(right[i], images.right.front(), 2) &&
            std::abs(right[i].y - left[i].y) <= options.max_epipolar &&
            plausibleDisparity(left[i].x - right[i].x, options, camera.width);
  keep(ok, left, right);
  Points back = left;
  ok = follow(images.right, images.left, right, back, kNearbyLevels, options);
  for (std::size_t i = 0; i < ok.size(); ++i)
    if (ok[i] != 0 && distance(back[i], left[i]) <= options.max_forward_backward)
      features.push_back({0, {left[i].x, left[i].y, right[i].x}});
  return features;
}

}  // namespace mvo
