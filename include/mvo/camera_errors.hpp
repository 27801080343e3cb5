// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a stereo pair was found to differ by from what its calibration claims, for those who want to
// know it, keep it, or calibrate again.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// A value and its standard deviation, in one unit.
struct Measured {
  double value = 0;
  double deviation = 0;
};

/// One number of the error's model.
struct CameraErrorTerm {
  std::string name;
  std::string unit;
  Measured measured;
};

/// All that is needed to go on from there with the same camera: a Gaussian over the model's terms.
struct LearntCameraErrors {
  StereoCamera camera;             ///< that it belongs to
  std::vector<std::string> terms;  ///< names, in the order of the following
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

/// The same as figures and a sentence. Errors are what is seen minus what an exact pair would see,
/// of far points. Single terms may cancel over the image; mounting and focal length are those that
/// together explain most of it.
struct CameraErrorReport {
  LearntCameraErrors learnt;
  std::vector<CameraErrorTerm> terms;
  Measured disparity;        ///< in the middle of the image [px]; negative: too small
  Measured disparity_rms;    ///< over the image [px]; its deviation is the rms of the deviations
  Measured rows;             ///< v_r - v_l in the middle [px]
  Measured rows_rms;         ///< [px]
  Measured yaw;              ///< how the right camera is turned: outwards (to the right) [deg]
  Measured pitch;            ///< upwards [deg]
  Measured roll;             ///< clockwise, as seen from behind [deg]
  Measured focal;            ///< the right focal length is longer by [%]
  Measured delay;            ///< the right image is later by [ms]
  Measured rest_rms;         ///< what yaw, pitch, roll and focal length leave unexplained [px]
  bool significant = false;  ///< far beyond its deviation, and beyond what matters
  std::string advice;        ///< one sentence, empty if not significant

  /// The largest error of disparities or rows [px].
  double largest() const;
};

}  // namespace mvo
