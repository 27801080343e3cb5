// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Undistortion and rectification of raw images by their calibration.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>
#include <string>

namespace mvo_ros {

/// Fixed-point maps from raw to rectified pixels, computed once.
class Rectification {
 public:
  /// Throws std::runtime_error, one sentence that begins with the topic, for a calibration without
  /// K or with an unknown distortion model.
  Rectification(const sensor_msgs::CameraInfo& info, const std::string& topic);

  /// The rectified grey image, bilinear; black where the raw image has no pixel.
  cv::Mat grey(const cv::Mat& raw) const;
  /// The rectified depth image, nearest neighbour (depth must not be mixed over edges); NaN where
  /// the raw image has no pixel.
  cv::Mat depth(const cv::Mat& raw) const;

 private:
  cv::Mat map_;            // 16SC2, whole pixels
  cv::Mat interpolation_;  // 16UC1, index of the fraction
};

}  // namespace mvo_ros
