// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Laws of the SE(3) operators.
#include "mvo/se3.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mvo {
namespace {

constexpr double kPi = 3.14159265358979323846;

class Se3 : public ::testing::Test {
 protected:
  Eigen::Vector3d vector(double scale) {
    std::uniform_real_distribution<double> uniform(-scale, scale);
    return {uniform(random_), uniform(random_), uniform(random_)};
  }
  Vector6d twist(double translation, double rotation) {
    Vector6d xi;
    xi << vector(translation), vector(1).normalized() * rotation;
    return xi;
  }

 private:
  std::mt19937 random_{7};
};

TEST(Se3Hand, KnownValues) {
  Vector6d xi;
  xi << 1, 2, 3, 0, 0, 0;
  EXPECT_TRUE(exp(xi).isApprox(Eigen::Isometry3d(Eigen::Translation3d(1, 2, 3)), 1e-15));

  // A quarter turn about z while moving along x ends at (2/pi, 2/pi, 0): an arc of radius 2/pi.
  xi << 1, 0, 0, 0, 0, kPi / 2;
  const Eigen::Isometry3d T = exp(xi);
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(2 / kPi, 2 / kPi, 0), 1e-15));
  EXPECT_TRUE((T.linear() * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-15));
}

TEST_F(Se3, HatIsTheCrossProduct) {
  const Eigen::Vector3d a = vector(2);
  const Eigen::Vector3d b = vector(2);
  EXPECT_TRUE((hat(a) * b).isApprox(a.cross(b), 1e-15));
}

TEST_F(Se3, ExpIsATransformAndLogItsInverse) {
  for (const double rotation :
       {0.0, 1e-12, 1e-9, 1e-8, 3e-8, 1e-6, 1e-4, 1e-2, 0.5, 2.0, 3.1, kPi - 1e-6, kPi - 1e-9}) {
    for (int i = 0; i < 20; ++i) {
      const Vector6d xi = twist(3, rotation);
      const Eigen::Isometry3d T = exp(xi);
      EXPECT_TRUE((T.linear().transpose() * T.linear()).isIdentity(1e-14));
      EXPECT_NEAR(T.linear().determinant(), 1, 1e-14);
      EXPECT_LT((log(T) - xi).norm(), rotation > 3.11 ? 1e-6 : 1e-13) << rotation;
      EXPECT_LT((exp(log(T)).matrix() - T.matrix()).norm(), 1e-13) << rotation;
      EXPECT_NEAR(angle(T.linear()), rotation, 1e-13);
    }
  }
}

TEST_F(Se3, ExpOfSmallTwistsIsAccurate) {
  // The series of the matrix exponential is the reference.
  for (const double rotation : {1e-10, 1e-9, 1e-8, 1.1e-8, 1e-7, 1e-6, 1e-5, 1e-4}) {
    const Vector6d xi = twist(1, rotation);
    Eigen::Matrix4d A = Eigen::Matrix4d::Zero();
    A.topLeftCorner<3, 3>() = hat(xi.tail<3>());
    A.topRightCorner<3, 1>() = xi.head<3>();
    Eigen::Matrix4d term = Eigen::Matrix4d::Identity();
    Eigen::Matrix4d sum = term;
    for (int k = 1; k < 8; ++k) sum += term = term * A / k;
    EXPECT_LT((exp(xi).matrix() - sum).cwiseAbs().maxCoeff(), 1e-15) << rotation;
  }
}

TEST_F(Se3, LogAtHalfATurnHasAngleInRange) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d axis = vector(1).normalized();
    const Eigen::Matrix3d C = Eigen::AngleAxisd(kPi, axis).toRotationMatrix();
    EXPECT_NEAR(angle(C), kPi, 1e-7);
    EXPECT_NEAR(std::abs(rotationVector(C).normalized().dot(axis)), 1, 1e-12);
    // One turn and a half is half a turn.
    EXPECT_LE(angle(Eigen::AngleAxisd(3 * kPi, axis).toRotationMatrix()), kPi + 1e-12);
    EXPECT_NEAR(angle(Eigen::AngleAxisd(kPi + 0.2, axis).toRotationMatrix()), kPi - 0.2, 1e-12);
  }
}

TEST_F(Se3, OdotIsTheDerivativeOfTheLeftPerturbation) {
  constexpr double kStep = 1e-6;
  for (const double w : {1.0, 0.1, 0.0, -0.01}) {
    Eigen::Vector4d p;
    p << vector(3), w;
    for (int i = 0; i < 6; ++i) {
      const Vector6d eps = kStep * Vector6d::Unit(i);
      const Eigen::Vector4d difference =
          (exp(eps).matrix() * p - exp(-eps).matrix() * p) / (2 * kStep);
      EXPECT_LT((odot(p).col(i) - difference.head<3>()).norm(), 1e-9);
      EXPECT_EQ(difference.w(), 0);
    }
  }
}

TEST_F(Se3, AdjointMovesAPerturbationToTheOtherSide) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d T = exp(twist(2, 1.5));
    const Eigen::Isometry3d S = exp(twist(2, 0.7));
    const Vector6d xi = twist(1, 0.3);
    EXPECT_LT(((T * exp(xi) * T.inverse()).matrix() - exp(adjoint(T) * xi).matrix()).norm(), 1e-13);
    EXPECT_LT((adjoint(T * S) - adjoint(T) * adjoint(S)).norm(), 1e-13);
  }
}

TEST_F(Se3, NearestRotationIsARotationAndNoneIsNearer) {
  for (int i = 0; i < 20; ++i) {
    const Eigen::Matrix3d C = exp(twist(1, 1.0)).linear();
    EXPECT_LT((nearestRotation(3 * C) - C).norm(), 1e-14);  // scale does not matter
    Eigen::Matrix3d M;
    M << vector(1), vector(1), vector(1);
    const Eigen::Matrix3d N = nearestRotation(M);
    EXPECT_TRUE((N.transpose() * N).isIdentity(1e-13));
    EXPECT_NEAR(N.determinant(), 1, 1e-13);
    for (int k = 0; k < 6; ++k) {
      const Eigen::Matrix3d other = exp(twist(0, 1e-3)).linear() * N;
      EXPECT_LE((M - N).norm(), (M - other).norm() + 1e-12);
    }
  }
  // A reflection: the nearest rotation flips the weakest direction back.
  const Eigen::Matrix3d mirror = Eigen::Vector3d(3, 2, -1).asDiagonal();
  EXPECT_LT((nearestRotation(mirror) - Eigen::Matrix3d::Identity()).norm(), 1e-14);
}

}  // namespace
}  // namespace mvo
