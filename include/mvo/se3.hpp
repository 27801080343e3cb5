// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Operators of SE(3) as Barfoot (State Estimation for Robotics, ch. 7) writes them: a twist is
// (rho, phi), translation first.
#pragma once

#include "mvo/types.hpp"

namespace mvo {

/// phi^: the skew-symmetric matrix of a 3-vector, hat(a) b = a x b.
Eigen::Matrix3d hat(const Eigen::Vector3d& phi);

/// exp(xi^): the transform of a twist (rho [m], phi [rad]).
Eigen::Isometry3d exp(const Vector6d& xi);

/// The twist of a transform; rotation angle in [0, pi]. exp(log(T)) = T.
Vector6d log(const Eigen::Isometry3d& T);

/// The rotation part of log [rad].
Eigen::Vector3d rotationVector(const Eigen::Matrix3d& C);

/// (p)^odot, top three rows: d(exp(eps^) p)/d(eps) at eps = 0 for a homogeneous point (x, y, z, w).
Eigen::Matrix<double, 3, 6> odot(const Eigen::Vector4d& p);

/// Ad(T): T exp(xi^) T^-1 = exp((Ad(T) xi)^).
Matrix6d adjoint(const Eigen::Isometry3d& T);

/// Angle of a rotation [rad].
double angle(const Eigen::Matrix3d& C);

/// The rotation nearest to M in the Frobenius norm: U diag(1, 1, det(U V^T)) V^T.
Eigen::Matrix3d nearestRotation(const Eigen::Matrix3d& M);

}  // namespace mvo
