// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a stereo pair differs by from what its calibration claims: where the right eye sees a point,
// against where an exact pair would, as a linear function of a few small numbers.
#pragma once

#include <Eigen/Core>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// The numbers, each the factor of one field over the right image. With (x, y) = ((u_r - c_u) /
/// f_u, (v - c_v) / f_v), r^2 = x^2 + y^2 and d the disparity / f_u, the shift (du / f_u, dv /
/// f_v) of what is seen is:
enum ErrorTerm {
  kAcross,       ///< (1, 0): the principal point
  kDown,         ///< (0, 1)
  kRoll,         ///< (-y, x) [rad]
  kScale,        ///< (x, y): the focal length, relative
  kRadial,       ///< (x r^2, y r^2)
  kTurn,         ///< (1 + x^2, x y): the mounting's yaw [rad]
  kTilt,         ///< (x y, 1 + y^2): its pitch [rad]
  kTangentialU,  ///< (r^2 + 2 x^2, 2 x y)
  kTangentialV,  ///< (2 x y, r^2 + 2 y^2)
  kWidth,        ///< (x, 0): pixels that are not square
  kShear,        ///< (y, 0)
  kRise,         ///< (0, d): the right eye above or below its place, relative to the baseline
  kDelay,        ///< the point's own velocity (f_u du / dt, f_v dv / dt): the eye is late [s]
  kErrorTerms
};

using ErrorVector = Eigen::Matrix<double, kErrorTerms, 1>;
using ErrorMatrix = Eigen::Matrix<double, kErrorTerms, kErrorTerms>;

/// The derivative of the shift (du, dv) [px] of a point's right half by the numbers. `y` is (u_l,
/// v, u_r) [px] and `velocity` that of (u_r, v) [px/s].
Eigen::Matrix<double, 2, kErrorTerms> errorFields(const StereoCamera& camera,
                                                  const Eigen::Vector3d& y,
                                                  const Eigen::Vector2d& velocity);

/// du [px] of a point, the product of the first row with the numbers; `velocity` is that of u_r.
double shiftAcross(const StereoCamera& camera, const Eigen::Vector3d& y, double velocity,
                   const ErrorVector& numbers);

/// The numbers as far as they are known.
struct ErrorEstimate {
  ErrorVector mean = ErrorVector::Zero();
  ErrorMatrix covariance = ErrorMatrix::Zero();

  /// Mean and standard deviation of the rows' difference v_r - v_l [px] where a point is.
  struct Rows {
    double mean = 0;
    double deviation = 0;
  };
  Rows rows(const StereoCamera& camera, const Eigen::Vector3d& y) const;
};

/// What is known before anything is seen: mountings bend by a tenth of a degree, focal lengths are
/// off by some thousandths, cheap triggers are some milliseconds apart. Single numbers may be large
/// where they cancel over the image, as a rectification's do.
ErrorEstimate expectedErrors(const StereoCamera& camera);

}  // namespace mvo
