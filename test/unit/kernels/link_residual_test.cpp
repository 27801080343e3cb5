// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Eq. (1) by hand, and what weighting by the measurements' noise must and must not change.
#include "kernels/link_residual.hpp"

#include <gtest/gtest.h>

#include <random>

#include "kernels/link.hpp"
#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 320, 240, 0.2, 640, 480};
const NoiseOptions kNoise;

LinkResidual imageDistance() { return {kCamera, kNoise, ResidualModel::kImageDistance}; }
LinkResidual whitened() { return {kCamera, kNoise, ResidualModel::kWhitened}; }

Eigen::Isometry3d shift(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

TEST(LinkResidual, IsEquationOneByHand) {
  // Disparity 25 px: 4 m ahead, 0.4 m right of the axis. The label moves it by (0.1, 0.2, 1) m to
  // (0.5, 0.2, 5) m, which is seen at (370, 260) px; it was seen at (373, 256) px.
  const Eigen::Vector3d y_a(370, 240, 345);
  const Eigen::Vector3d y_b(373, 256, 0);
  EXPECT_NEAR(imageDistance()(shift(0.1, 0.2, 1), y_a, y_b), 5.0, 1e-12);
  // The right image has no say in Eq. (1).
  EXPECT_NEAR(imageDistance()(shift(0.1, 0.2, 1), y_a, {373, 256, 350}), 5.0, 1e-12);
}

TEST(LinkResidual, WhitenedAgreesForSmallMotionsOfExactDisparity) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p(uniform(random), uniform(random), 4 + 2 * uniform(random));
    Vector6d xi;
    for (int j = 0; j < 6; ++j) xi(j) = 0.002 * uniform(random);
    const Eigen::Isometry3d T_b_a = exp(xi);
    const Eigen::Vector3d y_a = kCamera.project(p);
    const double du = 3 * uniform(random);
    // Displaced in the image; the disparity is as predicted.
    const Eigen::Vector3d y_b =
        kCamera.project(T_b_a * p) + Eigen::Vector3d(du, 3 * uniform(random), du);
    const double e = imageDistance()(T_b_a, y_a, y_b);
    EXPECT_NEAR(whitened()(T_b_a, y_a, y_b), e, 0.02 * e + 1e-9);
  }
}

TEST(LinkResidual, IsZeroForATrueMotionWithoutNoise) {
  const Eigen::Isometry3d T_b_a = exp((Vector6d() << 0.3, -0.1, 0.4, 0.1, 0.2, -0.1).finished());
  const Eigen::Vector3d p(0.5, -0.3, 3);
  const Eigen::Vector3d y_a = kCamera.project(p);
  const Eigen::Vector3d y_b = kCamera.project(T_b_a * p);
  EXPECT_NEAR(imageDistance()(T_b_a, y_a, y_b), 0, 1e-9);
  EXPECT_NEAR(whitened()(T_b_a, y_a, y_b), 0, 1e-6);
}

TEST(LinkResidual, WhitenedSeesWrongDisparityThatEquationOneDoesNot) {
  const Eigen::Vector3d y_a = kCamera.project({0.5, 0.2, 4});
  const Eigen::Vector3d y_b = y_a - Eigen::Vector3d(0, 0, 5);  // 5 px nearer
  const Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  EXPECT_NEAR(imageDistance()(T, y_a, y_b), 0, 1e-12);
  // Both disparities are noisy, 0.12 / 0.10 as noisy as u: 5 / 1.2.
  EXPECT_NEAR(whitened()(T, y_a, y_b), 5 / 1.2, 1e-9);
}

TEST(LinkResidual, FarPointIsNotBlamedForItsDepth) {
  // Disparity 2 px (50 m) with an error of 0.12 px, one standard deviation, and 8 m sideways:
  // Eq. (1) sees 80 px * 6 %, the noise explains it.
  const Eigen::Vector3d p(1, 0.5, 50);
  const Eigen::Isometry3d T_b_a = shift(-8, 0, 0);
  const Eigen::Vector3d y_a = kCamera.project(p) - Eigen::Vector3d(0, 0, 0.12);
  const Eigen::Vector3d y_b = kCamera.project(T_b_a * p);
  EXPECT_NEAR(imageDistance()(T_b_a, y_a, y_b), 4.8, 0.01);
  EXPECT_LT(whitened()(T_b_a, y_a, y_b), 3 * kNoise.left);
  // The same displacement across the epipolar line is no depth's fault.
  EXPECT_GT(whitened()(T_b_a, y_a, y_b + Eigen::Vector3d(0, 4.8, 0)), 4);
}

TEST(LinkResidual, BehindTheCamera) {
  const Eigen::Vector3d y_a = kCamera.project({0, 0, 4});
  const Eigen::Isometry3d T_b_a = shift(0, 0, -5);
  EXPECT_EQ(imageDistance()(T_b_a, y_a, y_a), kLinkBehind);
  EXPECT_EQ(whitened()(T_b_a, y_a, y_a), kLinkBehind);
  Link link;
  EXPECT_FALSE(whitened().linearize(T_b_a, y_a, y_a, &link));
}

TEST(LinkResidual, DisparityOfZeroOrLessIsVeryFar) {
  for (const double d : {0.0, -3.0}) {
    const Eigen::Vector3d y_a(400, 200, 400 - d);
    const double e = whitened()(shift(0.1, 0, 0.1), y_a, y_a);
    EXPECT_TRUE(std::isfinite(e));
    EXPECT_NEAR(imageDistance()(shift(0.1, 0, 0.1), y_a, y_a), 0, 0.1);
  }
}

TEST(LinkResidual, JacobianIsTheCentralDifferenceOfThePrediction) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const LinkResidual residual = whitened();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d y_a =
        kCamera.project({uniform(random), uniform(random), 4 + uniform(random)});
    Vector6d xi;
    for (int j = 0; j < 6; ++j) xi(j) = 0.2 * uniform(random);
    const Eigen::Isometry3d T_b_a = exp(xi);
    const Eigen::Vector3d y_b(320, 240, 300);
    Link link;
    ASSERT_TRUE(residual.linearize(T_b_a, y_a, y_b, &link));
    for (int j = 0; j < 6; ++j) {
      constexpr double kStep = 1e-6;
      Link plus;
      Link minus;
      ASSERT_TRUE(residual.linearize(exp(kStep * Vector6d::Unit(j)) * T_b_a, y_a, y_b, &plus));
      ASSERT_TRUE(residual.linearize(exp(-kStep * Vector6d::Unit(j)) * T_b_a, y_a, y_b, &minus));
      // The prediction falls as the residual rises.
      const Eigen::Vector3d numeric = (minus.residual - plus.residual) / (2 * kStep);
      EXPECT_LT((link.jacobian.col(j) - numeric).norm(), 1e-5 * (1 + numeric.norm()));
    }
    // e_k is the residual's weighted norm.
    EXPECT_NEAR(residual(T_b_a, y_a, y_b),
                std::sqrt(link.residual.dot(link.information * link.residual)), 1e-6);
  }
}

TEST(LinkResidual, InformationIsTheInverseCovarianceOfTheNoise) {
  // Monte Carlo: residuals of a true motion, whitened in units of the noise of u. Their expected
  // squared norm is 3 noise^2 times the two that make Eq. (1)'s scale.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Eigen::Isometry3d T_b_a = exp((Vector6d() << 0.5, 0, -0.3, 0, 0.1, 0).finished());
  const Eigen::Vector3d p(0.4, 0.3, 8);
  double sum = 0;
  constexpr int kSamples = 20000;
  for (int i = 0; i < kSamples; ++i) {
    const auto noisy = [&](Eigen::Vector3d y) {
      const double d = y.x() - y.z() + kNoise.disparity * normal(random);
      y.x() += kNoise.left * normal(random);
      y.y() += kNoise.left * normal(random);
      y.z() = y.x() - d;
      return y;
    };
    const double e =
        whitened()(T_b_a, noisy(kCamera.project(p)), noisy(kCamera.project(T_b_a * p)));
    sum += e * e;
  }
  EXPECT_NEAR(sum / kSamples, 2 * 3 * kNoise.left * kNoise.left, 0.002);
}

}  // namespace
}  // namespace mvo
