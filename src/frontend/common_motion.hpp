// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What points that move together have in common in the newest frame: how their motion differs from
// the predicted one. It tells where each of them is far more exactly than the past does.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Where a point was found, and where it had been expected.
struct FoundPoint {
  Eigen::Vector3d expected = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
  Eigen::Vector2d found = Eigen::Vector2d::Zero();     ///< (u_l, v) [px]
};

/// Where a point is expected in the left image.
struct ExpectedPlace {
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();              ///< [px]
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Identity();  ///< [px^2]
};

/// A small rigid motion on top of the predicted one, with its uncertainty.
class CommonMotion {
 public:
  /// The motion of most of the points; none from less than eight.
  static std::optional<CommonMotion> fit(const std::vector<FoundPoint>& points,
                                         const StereoCamera& camera);

  /// Where a point that moves like these is, by what had been expected of it, (u_l, v, u_r) [px].
  ExpectedPlace place(const Eigen::Vector3d& expected, const StereoCamera& camera) const;

 private:
  Vector6d twist_ = Vector6d::Zero();  // (rho [baselines], phi [rad])
  Matrix6d covariance_ = Matrix6d::Zero();
  double spread_ = 0;  // standard deviation of the points around it, of a coordinate [px]
};

}  // namespace mvo
