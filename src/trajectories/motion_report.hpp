// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is said of a motion beside its pose: where its points are, and whether it moves at all.
#pragma once

#include <vector>

#include "mvo/estimate.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Sets a motion's count, centroid and extent of the points that are seen in this frame. Points
/// with a disparity up to `min_disparity` [px] have no place.
void reportPoints(const std::vector<LabeledPoint>& points, const StereoCamera& camera,
                  double min_disparity, MotionEstimate& motion);

/// The largest distance of a motion's newest pose from its earlier ones among `poses`, of which its
/// first is held and the others are about as uncertain as the newest; see RestDistance. `of_camera`
/// is the covariance of the static world's motion.
double significanceOf(const MotionEstimate& motion, FrameId now, const Matrix6d& of_camera,
                      const std::vector<SmoothedPose>& poses);

}  // namespace mvo
