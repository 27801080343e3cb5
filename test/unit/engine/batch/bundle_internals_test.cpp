// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the batch of III-F is built from: its residual's Jacobians, and the elimination of landmarks
// against the full normal equations.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "engine/batch/bundle_problem.hpp"
#include "engine/batch/bundle_schur.hpp"
#include "support/bundle_scene.hpp"
#include "support/halves.hpp"

namespace mvo {
namespace {

class BundleResiduals : public ::testing::Test {
 protected:
  Eigen::Vector3d vector(double scale) {
    std::uniform_real_distribution<double> uniform(-scale, scale);
    return {uniform(random_), uniform(random_), uniform(random_)};
  }
  Eigen::Isometry3d transform() {
    Vector6d xi;
    xi << vector(0.3), vector(0.2);
    return exp(xi);
  }
  LandmarkChart chart() {
    const Eigen::Isometry3d T_c1_anchor = transform();
    LandmarkChart chart;
    chart.B << T_c1_anchor.linear().leftCols<2>(), T_c1_anchor.translation();
    chart.origin = T_c1_anchor.linear().col(2);
    return chart;
  }

 private:
  std::mt19937 random_{5};
};

TEST_F(BundleResiduals, JacobiansAreDerivatives) {
  constexpr double kStep = 1e-6;
  const Eigen::Vector3d gain(3300, 3400, 600);
  // From near points over infinity to disparities below zero.
  for (const double rho : {1.0, 0.2, 0.01, 0.0, -0.003})
    for (int i = 0; i < 20; ++i) {
      const Eigen::Isometry3d T = transform();
      const LandmarkChart in = chart();
      const Eigen::Vector3d m(vector(0.3).x(), vector(0.3).y(), rho);
      const Eigen::Vector3d h = vector(100);
      const auto residual = [&](const Eigen::Isometry3d& at, const Eigen::Vector3d& landmark) {
        return whitenedResidual(gain, at.linear(), at.translation(), in.point(landmark),
                                landmark.z(), h);
      };
      const BundleResidual r = linearizeResidual(gain, T.linear(), T.translation(), in, m, h);
      EXPECT_LT((r.e - residual(T, m)).norm(), 1e-11);
      for (int k = 0; k < 6; ++k) {
        const Vector6d eps = kStep * Vector6d::Unit(k);
        const Eigen::Vector3d difference =
            (residual(exp(eps) * T, m) - residual(exp(-eps) * T, m)) / (2 * kStep);
        EXPECT_LT((r.J_pose.col(k) - difference).norm(), 1e-3);  // of thousands
      }
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(k);
        const Eigen::Vector3d difference =
            (residual(T, m + step) - residual(T, m - step)) / (2 * kStep);
        EXPECT_LT((r.J_landmark.col(k) - difference).norm(), 1e-3);
      }
    }
}

TEST_F(BundleResiduals, ResidualIsTheWhitenedProjection) {
  const StereoCamera camera{500, 510, 319.5, 239.5, 0.24, 640, 480};
  const double left = 0.15;
  const double disparity = 0.2;
  const Eigen::Vector3d gain(camera.fu / left, camera.fv / left,
                             camera.fu * camera.baseline / disparity);
  const Eigen::Isometry3d T = transform();
  const LandmarkChart in = chart();
  const Eigen::Vector3d m(0.1, -0.2, 0.25);
  const Eigen::Vector3d p_ck = T * Eigen::Vector3d(in.point(m) / m.z());
  const Eigen::Vector3d y = camera.project(p_ck);
  const Eigen::Vector3d h((y.x() - camera.cu) / left, (y.y() - camera.cv) / left,
                          (y.x() - y.z()) / disparity);
  EXPECT_LT(whitenedResidual(gain, T.linear(), T.translation(), in.point(m), m.z(), h).norm(),
            1e-11);
}

TEST_F(BundleResiduals, BehindTheCameraIsFiniteAndLarge) {
  const Eigen::Vector3d gain(3300, 3300, 600);
  const LandmarkChart in = chart();
  const Eigen::Vector3d m(0.1, 0.1, 0.5);
  for (const double depth : {kLeastDepth, 1e-9, 0.0, -1e-9, -3.0}) {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.translation().z() = (depth - in.point(m).z()) / m.z();
    const auto r =
        linearizeResidual(gain, T.linear(), T.translation(), in, m, Eigen::Vector3d::Zero());
    EXPECT_TRUE(r.e.allFinite() && r.J_pose.allFinite() && r.J_landmark.allFinite());
    EXPECT_GT(r.e.norm(), 1e3);
  }
}

using ReducedSystemOfBothHalves = test::BothHalves;

std::optional<BundleProblem> problemOf(const test::BundleScene& scene,
                                       const BundleAdjustmentOptions& options = {}) {
  return makeBundleProblem(test::bundleOf(scene.start), scene.camera, scene.noise, options);
}

// The elimination against H dx = -g in full, built from the residuals alone.
TEST_P(ReducedSystemOfBothHalves, EliminationSolvesTheFullNormalEquations) {
  test::SceneOptions with;
  with.frames = 7;
  with.points = 25;
  with.max_length = 6;
  test::BundleScene scene = test::makeBundleScene(with);
  for (std::size_t j = 0; j < scene.start.landmarks.size(); j += 3) {  // gaps
    auto& of = scene.start.landmarks[j].observations;
    if (of.size() > 3) of.erase(of.begin() + 1);
  }
  const auto problem = problemOf(scene);
  ASSERT_TRUE(problem);
  const auto poses = static_cast<Eigen::Index>(6 * (problem->start.T_ck_c1.size() - 1));
  const auto n = poses + static_cast<Eigen::Index>(3 * problem->landmarks.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(n);
  double cost = 0;
  double squares = 0;
  for (std::size_t j = 0; j < problem->landmarks.size(); ++j)
    problem->forEachMeasurement(problem->landmarks[j], [&](int pose, const Eigen::Vector3d& h) {
      const auto& T = problem->start.T_ck_c1[static_cast<std::size_t>(pose)];
      const auto r = linearizeResidual(problem->gain, T.linear(), T.translation(),
                                       problem->landmarks[j].chart, problem->start.landmarks[j], h);
      Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, n);
      if (pose > 0) J.middleCols<6>(6 * (pose - 1)) = r.J_pose;
      J.middleCols<3>(poses + static_cast<Eigen::Index>(3 * j)) = r.J_landmark;
      const double weight = robustWeight(r.e.squaredNorm(), problem->robust_scale);
      H += weight * J.transpose() * J;
      g += weight * J.transpose() * r.e;
      cost += 0.5 * std::pow(problem->robust_scale, 2) *
              std::log1p(r.e.squaredNorm() / std::pow(problem->robust_scale, 2));
      squares += r.e.squaredNorm();
    });

  ReducedSystem system;
  system.setProblem(*problem);
  for (const double lambda : {0.0, 1e-3, 1.0}) {
    Eigen::MatrixXd damped = H;
    damped.diagonal() *= 1 + lambda;
    const Eigen::VectorXd dx = -damped.ldlt().solve(g);
    ASSERT_TRUE(system.factorize(problem->start, lambda));
    EXPECT_NEAR(system.cost().robust, cost, 1e-12 * cost);
    EXPECT_NEAR(system.cost().rms, std::sqrt(squares / (3 * problem->measurements)), 1e-12);
    const auto& step = system.step();
    for (std::size_t k = 1; k < step.poses.size(); ++k)
      EXPECT_LT((step.poses[k] - dx.segment<6>(static_cast<Eigen::Index>(6 * (k - 1)))).norm(),
                1e-8 * dx.head(poses).norm());
    for (std::size_t j = 0; j < step.landmarks.size(); ++j)
      EXPECT_LT(
          (step.landmarks[j] - dx.segment<3>(poses + static_cast<Eigen::Index>(3 * j))).norm(),
          1e-8 * dx.norm());
    EXPECT_NEAR(step.predicted, -g.dot(dx) - 0.5 * dx.dot(H * dx), 1e-8 * step.predicted);
    const BundleCost again = system.costAt(problem->start);
    EXPECT_NEAR(again.robust, cost, 1e-12 * cost);
  }
  EXPECT_FALSE(system.newestCovariance(2));  // damped
  ASSERT_TRUE(system.factorize(problem->start, 0));
  const Eigen::MatrixXd inverse = H.inverse();
  const Matrix6d newest = inverse.block<6, 6>(poses - 6, poses - 6);
  const auto last = system.newestCovariance(1);
  ASSERT_TRUE(last);
  EXPECT_LT((*last - newest).norm(), 1e-7 * newest.norm());
  const Eigen::MatrixXd last_two = inverse.block(poses - 12, poses - 12, 12, 12);
  EXPECT_LT((*system.newestCovariance(2) - last_two).norm(), 1e-7 * last_two.norm());
}

INSTANTIATE_TEST_SUITE_P(Halves, ReducedSystemOfBothHalves,
                         testing::Values(Half::kPortable, Half::kMachine), test::nameOfHalf);

}  // namespace
}  // namespace mvo
