// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "frontend/courses.hpp"

#include <algorithm>
#include <cstddef>

#include "frontend/rivals.hpp"

namespace mvo {

namespace {

constexpr std::ptrdiff_t kMany = 8;  // points that disagree may be right: enough for a motion
constexpr std::size_t kSample = 40;  // points of a motion that are looked at then; it takes time

// The points of one motion that were found.
struct Group {
  std::vector<FoundPoint> points;
  std::vector<cv::Point2f> before;  // where they were [px]
};

std::optional<CommonMotion> motionOf(const Group& group, const std::vector<cv::Mat>& pyramid,
                                     const StereoCamera& camera) {
  auto motion = CommonMotion::fit(group.points, camera);
  if (!motion) return motion;
  // Nearer to the nearest rival that there could be.
  const auto disagrees = [&](const FoundPoint& p) {
    return (p.found - motion->place(p.expected, camera).uv).norm() > 0.5 * kNearestRival;
  };
  if (std::count_if(group.points.begin(), group.points.end(), disagrees) < kMany) return motion;
  std::vector<FoundPoint> sure;
  const std::size_t n = group.points.size();
  const std::size_t sample = std::min(n, kSample);
  for (std::size_t k = 0; k < sample; ++k) {
    const std::size_t i = k * n / sample;
    if (findRivals(pyramid, group.before[i]).empty()) sure.push_back(group.points[i]);
  }
  const auto better = CommonMotion::fit(sure, camera);
  return better ? better : motion;
}

}  // namespace

std::vector<Course> coursesOf(const std::vector<Feature>& features, const TrackingPrior& prior) {
  std::vector<Course> courses;
  courses.reserve(features.size());
  for (const Feature& f : features) {
    const auto expected = prior.predicted.find(f.id);
    const auto motion = prior.motion_of.find(f.id);
    courses.push_back({expected != prior.predicted.end() ? expected->second : f.y,
                       motion != prior.motion_of.end() ? motion->second : -1});
  }
  return courses;
}

std::map<int, CommonMotion> commonMotions(const std::vector<Feature>& features,
                                          const std::vector<Course>& courses,
                                          const std::vector<std::optional<Feature>>& links,
                                          const std::vector<cv::Mat>& pyramid,
                                          const StereoCamera& camera) {
  std::map<int, Group> groups;
  for (std::size_t i = 0; i < links.size(); ++i) {
    if (!links[i]) continue;
    Group& group = groups[courses[i].motion];
    group.points.push_back({courses[i].expected, links[i]->y.head<2>()});
    group.before.emplace_back(static_cast<float>(features[i].y.x()),
                              static_cast<float>(features[i].y.y()));
  }
  std::map<int, CommonMotion> motions;
  for (const auto& [number, group] : groups)
    if (const auto motion = motionOf(group, pyramid, camera)) motions.emplace(number, *motion);
  return motions;
}

}  // namespace mvo
