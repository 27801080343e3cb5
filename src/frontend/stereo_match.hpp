// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// First guess of a new point's disparity: normalised correlation along the epipolar line.
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace mvo {

/// What is searched for along the epipolar line.
struct StereoSearch {
  int patch = 9;               ///< side [px]
  double max_disparity = 128;  ///< [px]
  double min_correlation = 0.7;
  double max_rival = 0.85;  ///< second-best peak / best peak, at most
  int first_down = 0;       ///< rows below the point's where the epipolar line may be, from ...
  int last_down = 0;        ///< ... to [px]
};

/// A match along the epipolar line, in whole pixels.
struct EpipolarMatch {
  double disparity = 0;  ///< u_left - u_right [px]
  int down = 0;          ///< v_right - v_left [px]
};

/// The best match of a patch around `p` in the right image, none if there is no clear one.
std::optional<EpipolarMatch> searchEpipolarLine(const cv::Mat& left, const cv::Mat& right,
                                                const cv::Point2f& p, const StereoSearch& search);

}  // namespace mvo
