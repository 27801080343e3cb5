// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/batch/newest_frame_start.hpp"

#include <gtest/gtest.h>

#include "support/bundle_scene.hpp"

namespace mvo {
namespace {

using test::BundleScene;

constexpr double kRobustScale = 0.5;  // the default's

BundleScene scene(double noise_scale = 1) {
  test::SceneOptions with;
  with.noise_scale = noise_scale;
  with.frames = 8;
  with.points = 80;
  with.max_length = 8;
  return test::makeBundleScene(with);
}

// A problem that starts at the truth; landmarks that `isKnown` says are known.
template <class IsKnown>
BundleProblem problemOf(const BundleScene& scene, const IsKnown& isKnown) {
  Bundle bundle = test::bundleOf(scene.truth);
  for (std::size_t j = 0; j < bundle.tracks.size(); ++j) bundle.tracks[j].is_known = isKnown(j);
  BundleAdjustmentOptions options;
  options.robust_scale = kRobustScale;
  return makeBundleProblem(bundle, scene.camera, scene.noise, options).value();
}

Eigen::Isometry3d shaken(const Eigen::Isometry3d& T) {
  Vector6d xi;
  xi << 0.02, -0.03, 0.04, 0.006, -0.008, 0.01;  // some 5 px, fifty standard deviations
  return exp(xi) * T;
}

double poseError(const BundleProblem& problem, const BundleScene& scene) {
  return log(problem.start.T_ck_c1.back() * scene.truth.T_ck_c1.back().inverse()).norm();
}

TEST(NewestFrameStart, BringsTheNewestPoseToKnownLandmarks) {
  for (const double noise : {0.0, 1.0}) {
    const BundleScene truth = scene(noise);
    BundleProblem problem = problemOf(truth, [](std::size_t) { return true; });
    problem.start.T_ck_c1.back() = shaken(problem.start.T_ck_c1.back());
    const double before = bundleCost(problem, problem.start).robust;
    ASSERT_GT(poseError(problem, truth), 0.05);
    startNewestFrame(problem);
    EXPECT_LT(poseError(problem, truth), noise > 0 ? 0.004 : 1e-8);
    EXPECT_LT(bundleCost(problem, problem.start).robust, before);
    for (std::size_t k = 0; k + 1 < problem.start.T_ck_c1.size(); ++k)
      EXPECT_EQ(problem.start.T_ck_c1[k].matrix(), truth.truth.T_ck_c1[k].matrix());
  }
}

TEST(NewestFrameStart, BringsNewLandmarksToThePoses) {
  const BundleScene truth = scene(0);
  const auto isKnown = [](std::size_t j) { return j % 3 != 0; };
  BundleProblem problem = problemOf(truth, isKnown);
  const auto exact = problem.start.landmarks;
  for (std::size_t j = 0; j < exact.size(); ++j)
    if (!isKnown(j)) problem.start.landmarks[j] += Eigen::Vector3d(0.002, -0.002, 0.02);
  startNewestFrame(problem);
  for (std::size_t j = 0; j < exact.size(); ++j)
    EXPECT_LT((problem.start.landmarks[j] - exact[j]).norm(), 1e-6) << j;
}

TEST(NewestFrameStart, NeverRaisesTheCost) {
  for (unsigned seed = 1; seed < 20; ++seed) {
    test::SceneOptions with;
    with.seed = seed;
    with.outliers = 0.3;
    const BundleScene truth = test::makeBundleScene(with);
    BundleProblem problem = problemOf(truth, [](std::size_t j) { return j % 4 != 0; });
    if (seed % 2 == 0) problem.start.T_ck_c1.back() = shaken(shaken(problem.start.T_ck_c1.back()));
    const double before = bundleCost(problem, problem.start).robust;
    startNewestFrame(problem);
    EXPECT_LE(bundleCost(problem, problem.start).robust, before * (1 + 1e-12)) << seed;
  }
}

TEST(NewestFrameStart, LeavesAColdStartAlone) {
  const BundleScene truth = scene();
  BundleProblem problem = problemOf(truth, [](std::size_t) { return false; });
  problem.start.T_ck_c1.back() = shaken(problem.start.T_ck_c1.back());
  const BundleState before = problem.start;
  startNewestFrame(problem);
  EXPECT_EQ(problem.start.T_ck_c1.back().matrix(), before.T_ck_c1.back().matrix());
  EXPECT_EQ(problem.start.landmarks, before.landmarks);
}

TEST(NewestFrameStart, LeavesAPoseWithTooFewKnownLandmarksAlone) {
  const BundleScene truth = scene();
  BundleProblem problem = problemOf(truth, [](std::size_t j) { return j < 2; });
  problem.start.T_ck_c1.back() = shaken(problem.start.T_ck_c1.back());
  const Eigen::Isometry3d before = problem.start.T_ck_c1.back();
  startNewestFrame(problem);
  EXPECT_EQ(problem.start.T_ck_c1.back().matrix(), before.matrix());
}

}  // namespace
}  // namespace mvo
