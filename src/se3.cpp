// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/se3.hpp"

#include <Eigen/SVD>
#include <cmath>

namespace mvo {

namespace {

constexpr double kSmallAngle = 1e-8;  // below this the series' first terms are exact in double

// J(phi), the left Jacobian of SO(3): rho enters exp as J rho. The textbook's 1 - cos(theta) and
// theta - sin(theta) cancel at small angles, these do not.
Eigen::Matrix3d leftJacobian(const Eigen::Vector3d& phi) {
  const double theta = phi.norm();
  const double square = theta * theta;
  const Eigen::Matrix3d W = hat(phi);
  if (theta < kSmallAngle) return Eigen::Matrix3d::Identity() + 0.5 * W;
  const double half_sinc = std::sin(0.5 * theta) / theta;
  const double cubic = theta < 1e-2 ? 1.0 / 6.0 - square / 120.0 + square * square / 5040.0
                                    : (theta - std::sin(theta)) / (square * theta);
  return Eigen::Matrix3d::Identity() + 2.0 * half_sinc * half_sinc * W + cubic * W * W;
}

}  // namespace

Eigen::Matrix3d hat(const Eigen::Vector3d& phi) {
  Eigen::Matrix3d W;
  W << 0, -phi.z(), phi.y(), phi.z(), 0, -phi.x(), -phi.y(), phi.x(), 0;
  return W;
}

Eigen::Isometry3d exp(const Vector6d& xi) {
  const Eigen::Vector3d phi = xi.tail<3>();
  const double theta = phi.norm();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = theta < kSmallAngle ? Eigen::Quaterniond(1.0, phi.x() / 2, phi.y() / 2, phi.z() / 2)
                                         .normalized()
                                         .toRotationMatrix()
                                   : Eigen::AngleAxisd(theta, phi / theta).toRotationMatrix();
  T.translation() = leftJacobian(phi) * xi.head<3>();
  return T;
}

Eigen::Vector3d rotationVector(const Eigen::Matrix3d& C) {
  const Eigen::Quaterniond q(C);
  const double s = q.vec().norm();
  if (s < kSmallAngle) return 2.0 * q.vec() * (q.w() < 0 ? -1.0 : 1.0);
  return 2.0 * std::atan2(q.w() < 0 ? -s : s, std::abs(q.w())) / s * q.vec();
}

Vector6d log(const Eigen::Isometry3d& T) {
  Vector6d xi;
  xi.tail<3>() = rotationVector(T.linear());
  xi.head<3>() = leftJacobian(xi.tail<3>()).partialPivLu().solve(T.translation());
  return xi;
}

Eigen::Matrix<double, 3, 6> odot(const Eigen::Vector4d& p) {
  Eigen::Matrix<double, 3, 6> P;
  P << p.w() * Eigen::Matrix3d::Identity(), -hat(p.head<3>());
  return P;
}

Matrix6d adjoint(const Eigen::Isometry3d& T) {
  Matrix6d A;
  A << T.linear(), hat(T.translation()) * T.linear(), Eigen::Matrix3d::Zero(), T.linear();
  return A;
}

double angle(const Eigen::Matrix3d& C) { return rotationVector(C).norm(); }

Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs = Eigen::Vector3d::Ones();
  signs.z() = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1.0 : 1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace mvo
