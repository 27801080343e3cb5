// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/circle_matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <optional>

#include "frontend/depth_association.hpp"
#include "frontend/detection.hpp"
#include "frontend/row_band.hpp"

namespace mvo {

namespace {

constexpr double kNear = 0.02;  // reach around a prediction, of the image width
constexpr double kFar = 0.08;   // without one
constexpr float kSnap = 0.20F;  // from a corner to its keypoint, of the spacing
// Points at infinity must find their match, or they would take another one; then they are left out.
constexpr double kBeyondInfinity = -2;   // [px]
constexpr int kMaxDifference = 32 * 12;  // of two descriptors of the same point
constexpr double kMaxRival = 0.85;       // best difference / second best, at most

// A keypoint of an image's set.
struct Place {
  int kind = 0;
  int index = 0;
};
bool operator==(const Place& a, const Place& b) { return a.kind == b.kind && a.index == b.index; }

// Where to look, in pixels.
struct SearchBox {
  float u0 = 0;
  float u1 = 0;
  float v0 = 0;
  float v1 = 0;
};

SearchBox around(const cv::Point2f& p, double reach) {
  const auto r = static_cast<float>(reach);
  return {p.x - r, p.x + r, p.y - r, p.y + r};
}

int difference(const Descriptor& a, const Descriptor& b) {
  int sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum;
}

// Calls visit(index) for the points within a box.
template <class Visit>
void forEachIn(const Keypoints& points, const SearchBox& box, const Visit& visit) {
  const int last_row = static_cast<int>(points.rows.size()) - 2;
  // A point is at most half a pixel from its row and column.
  const int first = std::max(0, static_cast<int>(std::floor(box.v0)));
  const int last = std::min(last_row, static_cast<int>(std::ceil(box.v1)));
  for (int v = first; v <= last; ++v) {
    const auto begin = points.positions.begin() + points.rows[v];
    const auto end = points.positions.begin() + points.rows[v + 1];
    auto it =
        std::lower_bound(begin, end, box.u0, [](const cv::Point2f& p, float u) { return p.x < u; });
    for (; it != end && it->x <= box.u1; ++it)
      if (it->y >= box.v0 && it->y <= box.v1)
        visit(static_cast<int>(it - points.positions.begin()));
  }
}

// The point of the same kind in a box that looks most alike, if clearly so.
std::optional<Place> bestIn(const KeypointSet& set, const SearchBox& box, int kind,
                            const Descriptor& descriptor) {
  std::optional<Place> best;
  int least = kMaxDifference;
  int second = least;
  forEachIn(set[kind], box, [&](int i) {
    const int d = difference(descriptor, set[kind].descriptors[i]);
    if (d < least) {
      second = least;
      least = d;
      best = Place{kind, i};
    } else {
      second = std::min(second, d);
    }
  });
  if (best && second < kMaxDifference && least > kMaxRival * second) return std::nullopt;
  return best;
}

const cv::Point2f& position(const KeypointSet& set, const Place& place) {
  return set[place.kind].positions[place.index];
}
const Descriptor& descriptorOf(const KeypointSet& set, const Place& place) {
  return set[place.kind].descriptors[place.index];
}

std::optional<Place> follow(const KeypointSet& from, const Place& place, const KeypointSet& to,
                            const SearchBox& box) {
  return bestIn(to, box, place.kind, descriptorOf(from, place));
}

// The strongest keypoint within reach.
std::optional<Place> strongestNear(const KeypointSet& set, const cv::Point2f& p, float reach) {
  std::optional<Place> best;
  float most = 0;
  for (int kind = 0; kind < static_cast<int>(set.size()); ++kind)
    forEachIn(set[kind], around(p, reach), [&](int i) {
      if (set[kind].contrast[i] <= most) return;
      most = set[kind].contrast[i];
      best = Place{kind, i};
    });
  return best;
}

// The part of the epipolar line, seen from the left (sign -1) or from the right (+1), where the
// disparity is within [low, high]; never far beyond infinity.
SearchBox epipolar(const cv::Point2f& p, int sign, double low, double high,
                   const TrackingPrior& prior, const StereoCamera& camera,
                   const FrontendOptions& options) {
  const auto near = static_cast<float>(p.x + sign * std::max(low, kBeyondInfinity));
  const auto far = static_cast<float>(p.x + sign * high);
  const RowBand rows = expectedRows({p.x, p.y, p.x}, prior, camera, options);
  const float row = p.y - static_cast<float>(sign) * rows.middle;
  return {std::min(near, far), std::max(near, far), row - rows.reach, row + rows.reach};
}

Feature measured(TrackletId id, const cv::Point2f& left, const cv::Point2f& right) {
  return {id, {left.x, left.y, right.x}, right.y};
}

// Runs `make` for each of n items on all threads; the results that exist, in order.
std::vector<Feature> collect(std::size_t n,
                             const std::function<std::optional<Feature>(std::size_t)>& make) {
  std::vector<std::optional<Feature>> results(n);
  cv::parallel_for_(cv::Range(0, static_cast<int>(n)), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i) results[i] = make(i);
  });
  std::vector<Feature> features;
  for (const auto& result : results)
    if (result) features.push_back(*result);
  return features;
}

}  // namespace

FrameImages describedImages(const Frame& frame, const FrontendOptions& options) {
  FrameImages images;
  images.left = {frame.left};
  images.left_points = findKeypoints(frame.left, options);
  if (!frame.right.empty()) {
    images.right = {frame.right};
    images.right_points = findKeypoints(frame.right, options);
  }
  images.depth = frame.depth;
  return images;
}

std::vector<Feature> matchAroundCircle(const FrameImages& from, const FrameImages& to,
                                       const std::vector<Feature>& features,
                                       const TrackingPrior& prior, const StereoCamera& camera,
                                       const FrontendOptions& options) {
  const double max_disparity = options.max_disparity * camera.width;
  return collect(features.size(), [&](std::size_t i) -> std::optional<Feature> {
    const Feature& f = features[i];
    const auto predicted = prior.predicted.find(f.id);
    const bool known = predicted != prior.predicted.end();
    const Eigen::Vector3d expected = known ? predicted->second : f.y;
    const double reach = (known ? kNear : kFar) * camera.width;
    const cv::Point2f start(static_cast<float>(f.y.x()), static_cast<float>(f.y.y()));
    const auto left_from = strongestNear(from.left_points, start, 0.01F);
    if (!left_from) return std::nullopt;

    const cv::Point2f goal(static_cast<float>(expected.x()), static_cast<float>(expected.y()));
    const auto left_to = follow(from.left_points, *left_from, to.left_points, around(goal, reach));
    if (!left_to) return std::nullopt;
    const cv::Point2f& p = position(to.left_points, *left_to);
    const cv::Point2f back = start - goal;  // the expected flow, reversed

    if (to.right.empty()) {  // RGB-D: the depth image closes the pair
      const auto closing =
          follow(to.left_points, *left_to, from.left_points, around(p + back, reach));
      if (!closing || !(*closing == *left_from)) return std::nullopt;
      const auto u_r = virtualRightColumn(to.depth, p, camera, options);
      return u_r ? std::make_optional(measured(f.id, p, cv::Point2f(static_cast<float>(*u_r), p.y)))
                 : std::nullopt;
    }

    const double disparity = expected.x() - expected.z();
    const double slack = kNear * camera.width;
    const auto right_to =
        follow(to.left_points, *left_to, to.right_points,
               epipolar(p, -1, disparity - slack, std::min(max_disparity, disparity + slack), prior,
                        camera, options));
    if (!right_to) return std::nullopt;
    const cv::Point2f& q = position(to.right_points, *right_to);
    if (p.x - q.x < options.min_disparity) return std::nullopt;
    const cv::Point2f q_back(q.x + static_cast<float>(f.y.z() - expected.z()), q.y + back.y);
    const auto right_from =
        follow(to.right_points, *right_to, from.right_points, around(q_back, reach));
    if (!right_from) return std::nullopt;
    const cv::Point2f& r = position(from.right_points, *right_from);
    if (std::abs(r.x - f.y.z()) > options.max_circle) return std::nullopt;
    const auto left_again =
        follow(from.right_points, *right_from, from.left_points,
               epipolar(r, 1, kBeyondInfinity, max_disparity, prior, camera, options));
    if (!left_again || !(*left_again == *left_from)) return std::nullopt;
    return measured(f.id, p, q);
  });
}

std::vector<Feature> matchNewKeypoints(const FrameImages& images,
                                       const std::vector<cv::Point2f>& corners,
                                       const TrackingPrior& prior, const StereoCamera& camera,
                                       const FrontendOptions& options) {
  const double max_disparity = options.max_disparity * camera.width;
  const auto snap = kSnap * static_cast<float>(spacingIn(images.left.front().size(), options));
  return collect(corners.size(), [&](std::size_t i) -> std::optional<Feature> {
    const auto left = strongestNear(images.left_points, corners[i], snap);
    if (!left) return std::nullopt;
    const cv::Point2f& p = position(images.left_points, *left);
    if (images.right.empty()) {
      const auto u_r = virtualRightColumn(images.depth, p, camera, options);
      return u_r ? std::make_optional(measured(0, p, cv::Point2f(static_cast<float>(*u_r), p.y)))
                 : std::nullopt;
    }
    const auto right =
        follow(images.left_points, *left, images.right_points,
               epipolar(p, -1, kBeyondInfinity, max_disparity, prior, camera, options));
    if (!right) return std::nullopt;
    const cv::Point2f& q = position(images.right_points, *right);
    if (p.x - q.x < options.min_disparity) return std::nullopt;
    const auto again =
        follow(images.right_points, *right, images.left_points,
               epipolar(q, 1, kBeyondInfinity, max_disparity, prior, camera, options));
    if (!again || !(*again == *left)) return std::nullopt;
    return measured(0, p, q);
  });
}

}  // namespace mvo
