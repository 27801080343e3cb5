// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Links by pyramidal Lucas-Kanade: over time with a forward-backward check, left-right, and the
// circle closed.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frontend/features.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

std::vector<cv::Mat> buildPyramid(const cv::Mat& image, const FrontendOptions& options);

/// The features (sorted by id) of frame `from` that are found in frame `to`, left_from -> left_to
/// -> right_to, where right_from -> right_to ends at the same place. Sorted by id.
std::vector<Feature> closeCircle(const FrameImages& from, const FrameImages& to,
                                 const std::vector<Feature>& features, const TrackingPrior& prior,
                                 const StereoCamera& camera, const FrontendOptions& options);

/// Stereo measurements of new corners; those without a clear match are left out. Ids are 0.
std::vector<Feature> matchNewPoints(const FrameImages& images,
                                    const std::vector<cv::Point2f>& corners,
                                    const TrackingPrior& prior, const StereoCamera& camera,
                                    const FrontendOptions& options);

}  // namespace mvo
