// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/klt.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "frontend/courses.hpp"
#include "frontend/depth_association.hpp"
#include "frontend/patch_flow.hpp"
#include "frontend/row_band.hpp"
#include "frontend/stereo_match.hpp"
#include "frontend/unambiguous.hpp"

namespace mvo {

namespace {

constexpr int kNearbyLevels = 1;        // pyramid levels where the start is known to a few pixels
constexpr int kBorder = 2;              // of the image, where points are lost [px]
constexpr float kFoundAnyway = 2;       // rows off by which correlation does not mind [px]
constexpr double kUsualDisparity = 10;  // where none is known yet [px]

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
cv::Point2f rightOf(const Feature& f) {
  return {static_cast<float>(f.y.z()), static_cast<float>(f.v_right)};
}

// The measurement of a stereo pair. Rows of a pair that is trusted are the same.
Feature measured(TrackletId id, const cv::Point2f& left, const cv::Point2f& right,
                 const TrackingPrior& prior) {
  return {id, {left.x, left.y, right.x}, prior.errors ? right.y : left.y};
}
Feature measured(TrackletId id, const cv::Point2f& left, double right_column) {
  return {id, {left.x, left.y, right_column}, left.y};
}

bool isStereoPair(const cv::Point2f& left, const cv::Point2f& right, const FrameImages& images,
                  const TrackingPrior& prior, const StereoCamera& camera,
                  const FrontendOptions& options) {
  const double disparity = left.x - right.x;
  const RowBand rows = expectedRows({left.x, left.y, left.x - disparity}, prior, camera, options);
  return inside(right, images.right.front(), kBorder) &&
         std::abs(right.y - left.y - rows.middle) <= rows.reach &&
         disparity >= options.min_disparity && disparity <= options.max_disparity * camera.width;
}

// One point around the circle of four images, from where it is expected at the coarsest of some
// levels; none where a side does not close.
std::optional<Feature> closeCircleOf(const Feature& feature, const Eigen::Vector3d& expected,
                                     int levels, const TrackingPrior& prior,
                                     const FrameImages& from, const FrameImages& to,
                                     const StereoCamera& camera, const FrontendOptions& options,
                                     PatchFlow& flow) {
  // Over time, there and back.
  const cv::Point2f left_from = leftOf(feature.y);
  cv::Point2f left_to = leftOf(expected);
  flow.take(from.left, left_from, levels);
  if (!flow.follow(to.left, left_to) || !inside(left_to, to.left.front(), kBorder))
    return std::nullopt;
  flow.take(to.left, left_to, kNearbyLevels);
  cv::Point2f back = left_from;
  if (!flow.follow(from.left, back) || distance(back, left_from) > options.max_forward_backward)
    return std::nullopt;

  if (to.right.empty()) {  // RGB-D: the depth image closes the pair
    const auto u_r = virtualRightColumn(to.depth, left_to, camera, options);
    if (!u_r) return std::nullopt;
    return measured(feature.id, left_to, *u_r);
  }

  // Left-right, from the expected disparity.
  const auto down = static_cast<float>(feature.v_right - feature.y.y());
  cv::Point2f right_to(left_to.x - static_cast<float>(expected.x() - expected.z()),
                       left_to.y + down);
  if (!flow.follow(to.right, right_to) ||
      !isStereoPair(left_to, right_to, to, prior, camera, options))
    return std::nullopt;

  // The circle's fourth side.
  cv::Point2f closing = right_to;
  flow.take(from.right, rightOf(feature), kNearbyLevels);
  if (!flow.follow(to.right, closing) || distance(closing, right_to) > options.max_circle)
    return std::nullopt;
  return measured(feature.id, left_to, right_to, prior);
}

// The stereo measurement of a new corner, there and back.
std::optional<Feature> matchNewPoint(const cv::Point2f& left, const FrameImages& images,
                                     const TrackingPrior& prior, const StereoCamera& camera,
                                     const FrontendOptions& options, PatchFlow& flow) {
  if (images.right.empty()) {
    const auto u_r = virtualRightColumn(images.depth, left, camera, options);
    if (!u_r) return std::nullopt;
    return measured(0, left, *u_r);
  }
  // A first guess at half resolution is enough for the rest.
  const std::size_t level = images.left.size() > 1 ? 1 : 0;
  const float scale = level == 1 ? 0.5F : 1.0F;
  StereoSearch search;
  search.max_disparity = options.max_disparity * camera.width * scale;
  const RowBand rows =
      expectedRows({left.x, left.y, left.x - kUsualDisparity}, prior, camera, options);
  // Rows that the correlation finds by itself need no search.
  const float search_reach = std::max(0.0F, rows.reach - kFoundAnyway);
  search.first_down = cvRound(scale * (rows.middle - search_reach));
  search.last_down = cvRound(scale * (rows.middle + search_reach));
  const auto match =
      searchEpipolarLine(images.left[level], images.right[level], left * scale, search);
  if (!match || match->disparity < 0) return std::nullopt;
  const auto down = static_cast<float>(match->down);
  cv::Point2f right(left.x - static_cast<float>(match->disparity / scale), left.y + down / scale);
  flow.take(images.left, left, kNearbyLevels);
  if (!flow.follow(images.right, right) ||
      !isStereoPair(left, right, images, prior, camera, options))
    return std::nullopt;
  cv::Point2f back = left;
  flow.take(images.right, right, kNearbyLevels);
  if (!flow.follow(images.left, back) || distance(back, left) > options.max_forward_backward)
    return std::nullopt;
  return measured(0, left, right, prior);
}

// Runs `make(i, flow)` for each of n points on all threads; the results in order.
template <class Make>
std::vector<std::optional<Feature>> forEach(std::size_t n, const FrontendOptions& options,
                                            const Make& make) {
  std::vector<std::optional<Feature>> results(n);
  cv::parallel_for_(cv::Range(0, static_cast<int>(n)), [&](const cv::Range& range) {
    PatchFlow flow(options.patch);
    for (int i = range.start; i < range.end; ++i) results[i] = make(i, flow);
  });
  return results;
}

std::vector<Feature> existing(const std::vector<std::optional<Feature>>& results) {
  std::vector<Feature> features;
  for (const auto& result : results)
    if (result) features.push_back(*result);
  return features;
}

}  // namespace

std::vector<cv::Mat> buildPyramid(const cv::Mat& image, const FrontendOptions& options) {
  return buildPaddedPyramid(image, options.patch, options.pyramid_levels);
}

std::vector<Feature> closeCircle(const FrameImages& from, const FrameImages& to,
                                 const std::vector<Feature>& features, const TrackingPrior& prior,
                                 const StereoCamera& camera, const FrontendOptions& options) {
  const std::vector<Course> courses = coursesOf(features, prior);
  const auto follow = [&](int i, const Eigen::Vector3d& expected, int levels, PatchFlow& flow) {
    return closeCircleOf(features[i], expected, levels, prior, from, to, camera, options, flow);
  };
  const auto links = forEach(features.size(), options, [&](int i, PatchFlow& flow) {
    return follow(i, courses[i].expected, options.pyramid_levels, flow);
  });
  if (!options.second_look) return existing(links);

  // Now that the others are found, a point that was taken for another one is found out, and where
  // it is.
  const auto motions = commonMotions(features, courses, links, from.left, camera);
  return existing(forEach(features.size(), options, [&](int i, PatchFlow& flow) {
    const auto& [expected, number] = courses[i];
    const auto motion = motions.find(number);
    if (!links[i] || motion == motions.end()) return links[i];
    const ExpectedPlace place = motion->second.place(expected, camera);
    const Sight before{from.left, leftOf(features[i].y)};
    const auto isSure = [&](const std::optional<Feature>& link) {
      return link && isUnambiguous(before, {to.left, leftOf(link->y)}, place, options.patch);
    };
    if (isSure(links[i])) return links[i];
    const Eigen::Vector2d shift = place.uv - expected.head<2>();
    const auto again =
        follow(i, expected + Eigen::Vector3d(shift.x(), shift.y(), shift.x()), kNearbyLevels, flow);
    return isSure(again) ? again : std::nullopt;
  }));
}

std::vector<Feature> matchNewPoints(const FrameImages& images,
                                    const std::vector<cv::Point2f>& corners,
                                    const TrackingPrior& prior, const StereoCamera& camera,
                                    const FrontendOptions& options) {
  return existing(forEach(corners.size(), options, [&](int i, PatchFlow& flow) {
    return matchNewPoint(corners[i], images, prior, camera, options, flow);
  }));
}

}  // namespace mvo
