// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What was learnt of the pair's error as a calibration message.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include "mvo/camera_errors.hpp"

namespace mvo_ros {

struct CorrectedInfo {
  sensor_msgs::CameraInfo right;
  double before_rms = 0;  ///< how far points are from where the calibration has them [px]
  double after_rms = 0;   ///< the same with the corrected one [px]
};

/// The right calibration whose rectification puts far points where an exact pair sees them, as far
/// as R, K and the first distortion coefficients can; P stays. Of several that are as good it is
/// the one that turns the camera rather than moves the principal point. Throws std::runtime_error,
/// one sentence, for a distortion model that is unknown.
CorrectedInfo correctedRight(const sensor_msgs::CameraInfo& right,
                             const mvo::LearntCameraErrors& learnt);

}  // namespace mvo_ros
