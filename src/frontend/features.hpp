// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The nouns of the front end (III): points, what is expected of them, and prepared images.
#pragma once

#include <Eigen/Core>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "frontend/camera/error_field.hpp"
#include "frontend/corner_peaks.hpp"
#include "frontend/keypoints.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A point seen in a frame: a link of a tracklet.
struct Feature {
  TrackletId id = 0;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
  double v_right = 0;                           ///< its row in the right image [px]
};

/// What is expected of the next frame: where known points will be, and where more points are
/// wanted.
struct TrackingPrior {
  std::map<TrackletId, Eigen::Vector3d>
      predicted;  ///< y in the next frame; points without one start where they are
  std::map<TrackletId, int> motion_of;  ///< points with the same number are thought to move alike
  std::map<TrackletId, bool>
      dense;  ///< points of moving bodies: their surroundings get more points
  std::optional<ErrorEstimate> errors;  ///< of the pair; none: it is trusted
};

/// Image pyramids (or keypoints) of one frame, as the trackers need them.
struct FrameImages {
  std::vector<cv::Mat> left;      ///< pyramid; the descriptor tracker needs the image only
  std::vector<cv::Mat> right;     ///< the same; empty for RGB-D
  cv::Mat depth;                  ///< RGB-D [m]
  cv::Mat mask;                   ///< 0 where a point's patch would see what is left out; or empty
  std::vector<CornerPeak> peaks;  ///< of the left image, where the mask allows
  KeypointSet left_points;        ///< descriptor tracker only
  KeypointSet right_points;       ///< the same
};

/// Whether a point is where the mask lets it be.
inline bool isAllowed(const cv::Mat& mask, const cv::Point& p) {
  return mask.empty() || (cv::Rect({0, 0}, mask.size()).contains(p) && mask.at<uchar>(p) != 0);
}

}  // namespace mvo
