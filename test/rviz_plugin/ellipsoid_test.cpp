// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/ellipsoid.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mvo_rviz {
namespace {

geometry_msgs::PoseWithCovariance withPositionCovariance(const Eigen::Matrix3d& covariance) {
  geometry_msgs::PoseWithCovariance pose;
  pose.covariance.fill(0.5);  // what is not of the position has no influence
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c)
      pose.covariance[6 * r + c] =
          covariance(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
  return pose;
}

TEST(Ellipsoid, HalfAxesAreStandardDeviations) {
  const auto pose = withPositionCovariance(Eigen::Vector3d(0.04, 0.01, 0.09).asDiagonal());
  const auto ellipsoid = positionEllipsoid(pose, 2);
  ASSERT_TRUE(ellipsoid);
  EXPECT_TRUE(ellipsoid->half_axes.isApprox(Eigen::Vector3d(0.2, 0.4, 0.6)));
  // The shortest axis is y, the longest is z.
  EXPECT_NEAR(std::abs((ellipsoid->orientation * Eigen::Vector3d::UnitX()).y()), 1, 1e-12);
  EXPECT_NEAR(std::abs((ellipsoid->orientation * Eigen::Vector3d::UnitZ()).z()), 1, 1e-12);
}

TEST(Ellipsoid, AxesAndOrientationGiveTheCovarianceBack) {
  Eigen::Matrix3d A;
  A << 0.3, 0.1, -0.2, 0.0, 0.5, 0.1, 0.4, -0.1, 0.2;
  const Eigen::Matrix3d covariance = A * A.transpose();
  const auto ellipsoid = positionEllipsoid(withPositionCovariance(covariance), 1);
  ASSERT_TRUE(ellipsoid);
  const Eigen::Matrix3d C = ellipsoid->orientation.toRotationMatrix();
  const Eigen::Matrix3d again = C * ellipsoid->half_axes.cwiseAbs2().asDiagonal() * C.transpose();
  EXPECT_TRUE(again.isApprox(covariance, 1e-9)) << again;
}

TEST(Ellipsoid, AFlatCovarianceIsADiscAndNoneAtAllIsAPoint) {
  const Eigen::Vector3d along = Eigen::Vector3d(1, 2, 3).normalized();
  const auto line = positionEllipsoid(withPositionCovariance(along * along.transpose()), 1);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->half_axes.x(), 0, 1e-6);
  EXPECT_NEAR(line->half_axes.z(), 1, 1e-9);
  const auto point = positionEllipsoid(withPositionCovariance(Eigen::Matrix3d::Zero()), 3);
  ASSERT_TRUE(point);
  EXPECT_EQ(point->half_axes, Eigen::Vector3d::Zero());
}

TEST(Ellipsoid, UnknownPositionsHaveNone) {
  const Eigen::Vector3d defects[] = {{9999, 9999, 9999},
                                     {1, 1, 9999},
                                     {-1, 1, 1},
                                     {1, std::numeric_limits<double>::quiet_NaN(), 1},
                                     {1, 1, std::numeric_limits<double>::infinity()}};
  for (const Eigen::Vector3d& variances : defects)
    EXPECT_FALSE(positionEllipsoid(withPositionCovariance(variances.asDiagonal()), 3))
        << variances.transpose();
  Eigen::Matrix3d indefinite = Eigen::Matrix3d::Identity();
  indefinite(0, 1) = indefinite(1, 0) = 2;
  EXPECT_FALSE(positionEllipsoid(withPositionCovariance(indefinite), 3));
}

}  // namespace
}  // namespace mvo_rviz
