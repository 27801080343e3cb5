// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links by descriptors: keypoints are matched around the circle of four images, and a link counts
// if it ends where it began. Quicker than Lucas-Kanade and free of drift, but less exact.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frontend/features.hpp"
#include "mvo/frame.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// The images' keypoints in place of their pyramids.
FrameImages describedImages(const Frame& frame, const FrontendOptions& options);

/// The features (sorted by id) of frame `from` that are found in frame `to`: left_from -> left_to
/// -> right_to -> right_from -> left_from leads back to the same keypoint. Sorted by id. The
/// features must be keypoints of `from`.
std::vector<Feature> matchAroundCircle(const FrameImages& from, const FrameImages& to,
                                       const std::vector<Feature>& features,
                                       const TrackingPrior& prior, const StereoCamera& camera,
                                       const FrontendOptions& options);

/// Stereo measurements of the keypoints next to new corners; those without a mutual match are left
/// out. Ids are 0.
std::vector<Feature> matchNewKeypoints(const FrameImages& images,
                                       const std::vector<cv::Point2f>& corners,
                                       const TrackingPrior& prior, const StereoCamera& camera,
                                       const FrontendOptions& options);

}  // namespace mvo
