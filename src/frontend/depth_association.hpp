// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// RGB-D: a depth image seen as a virtual right camera, u_r = u_l - f b / z.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// u_r [px] of a pixel (u, v); none over holes (NaN, <= 0), outside the depth range and across
/// depth edges.
std::optional<double> virtualRightColumn(const cv::Mat& depth, const cv::Point2f& p,
                                         const StereoCamera& camera,
                                         const FrontendOptions& options);

}  // namespace mvo
