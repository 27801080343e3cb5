// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// e_k, Eq. (1): how far a point lands from where it was seen when a label's motion carries it from
// one frame to another.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// A point seen in two frames a and b, (u_l, v, u_r) [px].
struct StereoPair {
  Eigen::Vector3d y_a;
  Eigen::Vector3d y_b;
};

/// Residual, its information and its derivative for one link a -> b. Components are (u, v,
/// disparity) [px].
struct Link {
  Eigen::Vector3d residual;     ///< seen - predicted
  Eigen::Matrix3d information;  ///< of the residual, in units of the noise of u [1/px^2 * px^2]
  Eigen::Matrix<double, 3, 6> jacobian;  ///< of the prediction w.r.t. a left perturbation of T_b_a
};

/// Eq. (1) as printed (image distance), or weighted by the covariance that the measurements of both
/// frames give it: a far or strongly displaced point is not blamed for its depth's uncertainty.
/// Both agree for small motions of a point with exact disparity.
class LinkResidual {
 public:
  LinkResidual(const StereoCamera& camera, const NoiseOptions& noise, ResidualModel model);

  /// e_k [px], >= 0; kLinkBehind if the point would be behind the camera.
  double operator()(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                    const Eigen::Vector3d& y_b) const;

  /// All that a Gauss-Newton step needs (always weighted). False if the point would be behind the
  /// camera.
  bool linearize(const Eigen::Isometry3d& T_b_a, const Eigen::Vector3d& y_a,
                 const Eigen::Vector3d& y_b, Link* link) const;

  const StereoCamera& camera() const { return camera_; }
  ResidualModel model() const { return model_; }
  double disparityVariance() const { return ratio2_; }  ///< relative to that of u

 private:
  StereoCamera camera_;
  ResidualModel model_;
  double ratio2_;  // variance of the disparity relative to that of u
};

}  // namespace mvo
