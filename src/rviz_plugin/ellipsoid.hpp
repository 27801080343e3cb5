// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The ellipsoid in which a position is, given its covariance.
#pragma once

#include <geometry_msgs/PoseWithCovariance.h>

#include <Eigen/Geometry>
#include <optional>

namespace mvo_rviz {

/// Half axes along the columns of the rotation that `orientation` is.
struct Ellipsoid {
  Eigen::Vector3d half_axes = Eigen::Vector3d::Zero();  ///< [m], ascending
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Of the position, `sigmas` standard deviations large, in the pose's axes of reference. Nothing if
/// the position is unknown (9999 or a negative variance) or the matrix is no covariance.
std::optional<Ellipsoid> positionEllipsoid(const geometry_msgs::PoseWithCovariance& pose,
                                           double sigmas);

}  // namespace mvo_rviz
