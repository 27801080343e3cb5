// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Repetitive texture: places around a point that look like it.
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace mvo {

/// No rival is nearer than that [px].
constexpr double kNearestRival = 4;

/// What pyramidal tracking may be led astray by [px].
constexpr double kFarthestRival = 24;

/// Places around p [px] that a tracker may take for it, relative to it and to about a pixel: within
/// `reach` px along u and v, at least, nearest first, the nearest eight only. Time grows with the
/// reach's square; beyond kFarthestRival nothing is looked for.
std::vector<Eigen::Vector2f> findRivals(const std::vector<cv::Mat>& pyramid, const cv::Point2f& p,
                                        double reach = kFarthestRival);

}  // namespace mvo
