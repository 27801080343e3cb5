// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// s(.): the rectified stereo camera and its inverse (III). The only sensor model of the package.
#pragma once

#include <string>

#include "mvo/types.hpp"

namespace mvo {

/// A rectified stereo pair. Camera frame: left optical (z forward, x right, y down).
struct StereoCamera {
  double fu = 0;        ///< focal length along u [px]
  double fv = 0;        ///< focal length along v [px]
  double cu = 0;        ///< principal point [px]
  double cv = 0;        ///< principal point [px]
  double baseline = 0;  ///< b, distance of the right camera along +x [m]; virtual for RGB-D
  int width = 0;        ///< [px]
  int height = 0;       ///< [px]

  /// s(p): (u_l, v, u_r) [px] of a point in the camera frame [m]. Needs p.z > 0.
  Eigen::Vector3d project(const Eigen::Vector3d& p) const;
  /// s^-1(y): the point [m] of a measurement. Needs a disparity u_l - u_r > 0.
  Eigen::Vector3d backProject(const Eigen::Vector3d& y) const;
  /// u_r of a pixel column with a known depth [m], as a virtual right camera would see it.
  double rightColumn(double u_left, double depth) const { return u_left - fu * baseline / depth; }

  /// Throws std::invalid_argument naming the value that cannot be a calibration.
  void validate() const;
};

}  // namespace mvo
