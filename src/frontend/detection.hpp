// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Salient points, spread over the image: the best of every empty cell of a grid, denser on moving
// bodies.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frontend/features.hpp"
#include "mvo/options.hpp"

namespace mvo {

/// Least distance of new points [px] in images of a size.
double spacingIn(const cv::Size& size, const FrontendOptions& options);

/// New corners [px] among an image's peaks, away from the known points. At most
/// options.max_features together with them; cells in poorly covered regions come first, so a weak
/// texture is not starved by a strong one.
std::vector<cv::Point2f> detectCorners(const std::vector<CornerPeak>& peaks, const cv::Size& size,
                                       const std::vector<Feature>& known,
                                       const TrackingPrior& prior, const FrontendOptions& options);

}  // namespace mvo
