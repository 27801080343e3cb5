// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/uncertainty.hpp"

#include <cmath>

#include "mvo/se3.hpp"

namespace mvo {

Matrix6d poseCovariance(const Eigen::Isometry3d& T_a_c, const Eigen::Isometry3d& T_c_x,
                        const Matrix6d& eta) {
  // p = T_a_c exp(eta^) p_c_x moves by C (rho + phi x p_c_x), the rotation by C phi.
  const Eigen::Matrix3d C = T_a_c.linear();
  Matrix6d J = Matrix6d::Zero();
  J.topLeftCorner<3, 3>() = C;
  J.topRightCorner<3, 3>() = -C * hat(T_c_x.translation());
  J.bottomRightCorner<3, 3>() = C;
  return J * eta * J.transpose();
}

Matrix6d stepCovariance(const Eigen::Isometry3d& T_c_x, const Matrix6d& eta) {
  const Matrix6d J = adjoint(T_c_x.inverse());
  return J * eta * J.transpose();
}

double RestDistance::operator()(const Eigen::Isometry3d& T_x1_x2) const {
  if (factor_.info() != Eigen::Success || !factor_.isPositive()) return 0;
  const Vector6d xi = log(T_x1_x2);
  const double distance = xi.dot(factor_.solve(xi));
  return std::isfinite(distance) && distance > 0 ? distance : 0;
}

}  // namespace mvo
