// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/uncertainty.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const Eigen::Isometry3d T_a_c = exp((Vector6d() << 1, -2, 3, 0.4, -0.5, 0.6).finished());
const Eigen::Isometry3d T_c_x = exp((Vector6d() << -0.3, 0.2, 4, -0.7, 0.1, 0.2).finished());

Matrix6d someCovariance() {
  Matrix6d A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = std::sin(1.7 * i) + (i % 7 == 0 ? 2 : 0);
  return 1e-4 * A * A.transpose();
}

// Central differences of a function of eta that is zero at zero.
Matrix6d jacobian(const std::function<Vector6d(const Vector6d&)>& f) {
  constexpr double h = 1e-6;
  Matrix6d J;
  for (int i = 0; i < 6; ++i)
    J.col(i) = (f(h * Vector6d::Unit(i)) - f(-h * Vector6d::Unit(i))) / (2 * h);
  return J;
}

TEST(Uncertainty, PoseCovarianceFollowsThePose) {
  const Eigen::Isometry3d T = T_a_c * T_c_x;
  const Matrix6d J = jacobian([&](const Vector6d& eta) {
    const Eigen::Isometry3d moved = T_a_c * exp(eta) * T_c_x;
    Vector6d out;
    out << moved.translation() - T.translation(),
        rotationVector(moved.linear() * T.linear().transpose());
    return out;
  });
  const Matrix6d expected = J * someCovariance() * J.transpose();
  EXPECT_LT((poseCovariance(T_a_c, T_c_x, someCovariance()) - expected).norm(),
            1e-6 * expected.norm());
}

TEST(Uncertainty, StepCovarianceFollowsTheStep) {
  // T_x1_x2 = T_x_c exp(eta) T_c_x for a body at rest in the camera.
  const Matrix6d J =
      jacobian([](const Vector6d& eta) { return log(T_c_x.inverse() * exp(eta) * T_c_x); });
  const Matrix6d expected = J * someCovariance() * J.transpose();
  EXPECT_LT((stepCovariance(T_c_x, someCovariance()) - expected).norm(), 1e-6 * expected.norm());
}

TEST(Uncertainty, RestDistanceCountsStandardDeviations) {
  const RestDistance distance(0.01 * Matrix6d::Identity());
  const Eigen::Isometry3d T = exp(0.3 * Vector6d::Unit(1));
  EXPECT_NEAR(distance(T), 9, 1e-9);
  EXPECT_EQ(distance(Eigen::Isometry3d::Identity()), 0);
  EXPECT_EQ(RestDistance(Matrix6d::Constant(NAN))(T), 0);
}

}  // namespace
}  // namespace mvo
