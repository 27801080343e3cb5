// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Calibration messages to the library's camera.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <string>

#include "mvo/stereo_camera.hpp"

namespace mvo_ros {

/// The rectified camera of a pair of calibrations, binning and region of interest taken into
/// account. Throws std::runtime_error, one sentence that begins with the topic at fault, if a
/// calibration is all zero, has no baseline, or if the two do not belong to one rectified pair.
mvo::StereoCamera stereoCamera(const sensor_msgs::CameraInfo& left,
                               const sensor_msgs::CameraInfo& right, const std::string& left_topic,
                               const std::string& right_topic);

/// The camera of a colour image with registered depth; its right camera is virtual, `baseline` [m]
/// away. Throws like stereoCamera.
mvo::StereoCamera rgbdCamera(const sensor_msgs::CameraInfo& color, double baseline,
                             const std::string& topic);

/// The right calibration with the left one's projection (focal lengths and principal point) and
/// its own baseline: what raw images are rectified to. The same as `right` for a usual calibration.
sensor_msgs::CameraInfo alignedRight(const sensor_msgs::CameraInfo& left,
                                     sensor_msgs::CameraInfo right);

}  // namespace mvo_ros
