// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the odometry is fed with: one set of images.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// One synchronized set of rectified images. Stereo: left and right; RGB-D: left (the colour image)
/// and depth.
struct Frame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1
  cv::Mat right;  ///< 8UC1, empty for RGB-D
  cv::Mat depth;  ///< 32FC1 [m], registered to left, NaN or <= 0 = hole; empty for stereo
  /// 8UC1, of left: 0 = not to be looked at (what is fixed to the camera); empty: all is.
  cv::Mat mask = {};
};

struct FrameImages;

/// A frame and what of its work depends on its images alone, see prepareFrame().
struct PreparedFrame {
  std::int64_t stamp_ns = 0;
  std::shared_ptr<FrameImages> images;  ///< none if there is a problem
  std::string problem;                  ///< what is wrong with the images, or empty
  double prepare_ms = 0;                ///< that it took
};

/// Does the work that depends on a frame's images alone, so that another thread may do it ahead:
/// checks types and sizes against the calibration, builds pyramids (or keypoints), finds corners.
/// Never throws for bad images: `problem` says what is wrong with them.
PreparedFrame prepareFrame(const Frame& frame, const StereoCamera& camera,
                           const FrontendOptions& options);

}  // namespace mvo
