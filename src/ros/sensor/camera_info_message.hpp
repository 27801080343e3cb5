// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The library's camera to calibration messages, as a driver would send them.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "mvo/stereo_camera.hpp"

namespace mvo_ros {

/// Of rectified images without distortion. `baseline` [m] is 0 for the left camera and for RGB-D.
sensor_msgs::CameraInfo cameraInfo(const std_msgs::Header& header, const mvo::StereoCamera& camera,
                                   double baseline);

}  // namespace mvo_ros
