// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/ellipsoid.hpp"

#include <Eigen/Eigenvalues>

namespace mvo_rviz {

namespace {

constexpr double kUnknownVariance = 9999;  // as the messages say it

}  // namespace

std::optional<Ellipsoid> positionEllipsoid(const geometry_msgs::PoseWithCovariance& pose,
                                           double sigmas) {
  using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor6d> all(pose.covariance.data());
  const Eigen::Matrix3d block = all.topLeftCorner<3, 3>();
  if (!block.allFinite() || block.diagonal().maxCoeff() >= kUnknownVariance) return std::nullopt;
  const Eigen::Matrix3d symmetric = 0.5 * (block + block.transpose());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(symmetric);
  const Eigen::Vector3d& variances = solver.eigenvalues();
  // Rounding may leave a flat covariance slightly negative, no more than that.
  const double tolerance = 1e-9 * std::max(variances.cwiseAbs().maxCoeff(), 1e-12);
  if (solver.info() != Eigen::Success || variances.minCoeff() < -tolerance) return std::nullopt;
  Eigen::Matrix3d C = solver.eigenvectors();
  if (C.determinant() < 0) C.col(2) = -C.col(2);
  return Ellipsoid{sigmas * variances.cwiseMax(0).cwiseSqrt(), Eigen::Quaterniond(C)};
}

}  // namespace mvo_rviz
