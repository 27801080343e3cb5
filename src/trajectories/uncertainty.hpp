// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From the batches' covariances to those of poses, velocities and of being at rest. A batch
// perturbs T_ck_c1 from the left, so its covariance lives in the camera's frame C_k; that of a
// third-party motion in the world is the sum of its own and the camera's.
#pragma once

#include <Eigen/Cholesky>

#include "mvo/types.hpp"

namespace mvo {

/// Of (position, rotation about fixed axes) of T_a_x = T_a_c exp(eta^) T_c_x, in the axes of a, for
/// the covariance of eta [m^2, m rad, rad^2].
Matrix6d poseCovariance(const Eigen::Isometry3d& T_a_c, const Eigen::Isometry3d& T_c_x,
                        const Matrix6d& eta);

/// Of log(T_xkm1_xk) over a short step, in the axes of x, for the covariance of the step's
/// perturbation in the camera's frame.
Matrix6d stepCovariance(const Eigen::Isometry3d& T_c_x, const Matrix6d& eta);

/// How far two poses of a body are apart, in squared standard deviations (six degrees of freedom):
/// at rest, this is above 22.5 once in a thousand times. 0 if the covariance, which is factored
/// once for many poses, is singular.
class RestDistance {
 public:
  explicit RestDistance(const Matrix6d& covariance) : factor_(covariance) {}
  double operator()(const Eigen::Isometry3d& T_x1_x2) const;

 private:
  Eigen::LDLT<Matrix6d> factor_;
};

/// The 99.9 % quantile of RestDistance at rest.
constexpr double kRestQuantile = 22.458;

}  // namespace mvo
