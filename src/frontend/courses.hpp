// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How points are thought to move, and what the newest frame says about that.
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "frontend/common_motion.hpp"
#include "frontend/features.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Where a point is expected, (u_l, v, u_r) [px], and with which others it moves (-1: those without
/// a motion).
struct Course {
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();
  int motion = -1;
};

/// One per feature.
std::vector<Course> coursesOf(const std::vector<Feature>& features, const TrackingPrior& prior);

/// How each motion differs from what was expected of it, by its points that were found (one link
/// per feature). Where many disagree, only by points that nothing around them in `pyramid`, that of
/// the frame before, looks like: most of them may be on a texture that repeats itself. Motions of
/// too few points are left out.
std::map<int, CommonMotion> commonMotions(const std::vector<Feature>& features,
                                          const std::vector<Course>& courses,
                                          const std::vector<std::optional<Feature>>& links,
                                          const std::vector<cv::Mat>& pyramid,
                                          const StereoCamera& camera);

}  // namespace mvo
