// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-B: the dominant motion between two frames.
#include "engine/ransac.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "mvo/se3.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 319.5, 239.5, 0.24, 640, 480};
const Eigen::Isometry3d kMotion =
    exp((Vector6d() << 0.08, -0.03, 0.1, 0.02, -0.03, 0.01).finished());
const LinkResidual kWhitened(kCamera, {}, ResidualModel::kWhitened);

// `good` pairs that follow a motion, then `bad` ones that follow none.
std::vector<StereoPair> makePairs(int good, int bad, double noise, unsigned seed,
                                  const Eigen::Isometry3d& T_b_a = kMotion) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal(0, 1);
  const auto noisy = [&](const Eigen::Vector3d& y) -> Eigen::Vector3d {
    return y + noise * Eigen::Vector3d(normal(random), normal(random), normal(random));
  };
  const auto anywhere = [&] {
    const double u = 60 + 560 * uniform(random);
    return Eigen::Vector3d(u, 480 * uniform(random), u - 5 - 40 * uniform(random));
  };
  std::vector<StereoPair> pairs;
  for (int i = 0; i < good; ++i) {
    const Eigen::Vector3d p(3 * (uniform(random) - 0.5), 2 * (uniform(random) - 0.5),
                            3 + 4 * uniform(random));
    pairs.push_back({noisy(kCamera.project(p)), noisy(kCamera.project(T_b_a * p))});
  }
  for (int i = 0; i < bad; ++i) pairs.push_back({anywhere(), anywhere()});
  return pairs;
}

double apart(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  return log(a * b.inverse()).norm();
}

TEST(Ransac, RecoversExactMotionWithoutNoise) {
  for (const bool refine : {true, false}) {
    ProposalOptions options;
    options.refine = refine;
    const auto motion = ransacMotion(makePairs(40, 0, 0, 1), kWhitened, options, 1);
    ASSERT_TRUE(motion);
    EXPECT_LT(apart(motion->T_b_a, kMotion), 1e-8) << "refine " << refine;
    EXPECT_EQ(motion->inliers, 40);
    EXPECT_EQ(motion->inlier, std::vector<char>(40, 1));
  }
}

TEST(Ransac, RecoversTheMotionAmongFiftyPercentOutliers) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const auto motion =
        ransacMotion(makePairs(60, 60, 0.1, static_cast<unsigned>(seed)), kWhitened, {}, seed);
    ASSERT_TRUE(motion);
    EXPECT_LT(apart(motion->T_b_a, kMotion), 0.005);
    int right = 0;
    for (int i = 0; i < 120; ++i) right += (motion->inlier[i] != 0) == (i < 60) ? 1 : 0;
    EXPECT_GE(right, 118);
    EXPECT_EQ(motion->inliers, std::count(motion->inlier.begin(), motion->inlier.end(), 1));
  }
}

TEST(Ransac, FewerThanThreePairsHaveNoMotion) {
  for (int n = 0; n < 3; ++n)
    EXPECT_FALSE(ransacMotion(makePairs(n, 0, 0, 1), kWhitened, {}, 1, kMotion)) << n;
  EXPECT_TRUE(ransacMotion(makePairs(3, 0, 0, 1), kWhitened, {}, 1));
}

TEST(Ransac, CollinearPointsHaveNoMotion) {
  std::vector<StereoPair> pairs;
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p(-1 + 0.1 * i, 0.5 - 0.02 * i, 4 + 0.05 * i);
    pairs.push_back({kCamera.project(p), kCamera.project(kMotion * p)});
  }
  EXPECT_FALSE(ransacMotion(pairs, kWhitened, {}, 1));
  // One point beside the line is enough.
  const Eigen::Vector3d p(0.3, -0.6, 5);
  pairs.push_back({kCamera.project(p), kCamera.project(kMotion * p)});
  const auto motion = ransacMotion(pairs, kWhitened, {}, 1);
  ASSERT_TRUE(motion);
  EXPECT_LT(apart(motion->T_b_a, kMotion), 1e-6);
}

TEST(Ransac, OnePointManyTimesHasNoMotion) {
  const StereoPair pair{kCamera.project({0.1, 0.2, 4}), kCamera.project({0.2, 0.2, 4})};
  EXPECT_FALSE(ransacMotion(std::vector<StereoPair>(10, pair), kWhitened, {}, 1));
}

TEST(Ransac, NoiseWithoutAMotionHasFewInliers) {
  const auto motion = ransacMotion(makePairs(0, 60, 0, 4), kWhitened, {}, 1);
  if (motion) {
    EXPECT_GE(motion->inliers, 3);
    EXPECT_LT(motion->inliers, 10);
  }
}

TEST(Ransac, IsDeterministicInTheSeed) {
  const auto pairs = makePairs(50, 40, 0.2, 3);
  const auto first = ransacMotion(pairs, kWhitened, {}, 11);
  const auto again = ransacMotion(pairs, kWhitened, {}, 11);
  ASSERT_TRUE(first && again);
  EXPECT_EQ(first->T_b_a.matrix(), again->T_b_a.matrix());
  EXPECT_EQ(first->inlier, again->inlier);
  ProposalOptions raw;
  raw.refine = false;
  const auto here = ransacMotion(pairs, kWhitened, raw, 11);
  const auto there = ransacMotion(pairs, kWhitened, raw, 12);
  ASSERT_TRUE(here && there);
  EXPECT_NE(here->T_b_a.matrix(), there->T_b_a.matrix());
}

TEST(Ransac, MsacRanksBetterThanTheCountAtAWideThreshold) {
  ProposalOptions options;
  options.threshold = 4;  // with noise of 0.3 px, nearly every sample has all inliers
  options.refine = false;
  options.confidence = 1;
  options.iterations = 200;
  double msac = 0;
  double count = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto pairs = makePairs(60, 0, 0.3, seed);
    options.ranking = Ranking::kMsac;
    const auto by_msac = ransacMotion(pairs, kWhitened, options, seed);
    options.ranking = Ranking::kCount;
    const auto by_count = ransacMotion(pairs, kWhitened, options, seed);
    ASSERT_TRUE(by_msac && by_count);
    msac += apart(by_msac->T_b_a, kMotion);
    count += apart(by_count->T_b_a, kMotion);
  }
  EXPECT_LT(msac, 0.8 * count);
}

TEST(Ransac, TriesTheGuessFirst) {
  ProposalOptions options;
  options.iterations = 0;
  options.refine = false;
  const auto pairs = makePairs(30, 10, 0, 6);
  EXPECT_FALSE(ransacMotion(pairs, kWhitened, options, 1));
  const auto motion = ransacMotion(pairs, kWhitened, options, 1, kMotion);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->T_b_a.matrix(), kMotion.matrix());
  EXPECT_GE(motion->inliers, 30);
}

TEST(Ransac, AWrongGuessDoesNotWin) {
  const auto motion = ransacMotion(makePairs(60, 20, 0.1, 8), kWhitened, {}, 1,
                                   exp((Vector6d() << 0.5, 0, 0, 0, 0, 0.2).finished()));
  ASSERT_TRUE(motion);
  EXPECT_LT(apart(motion->T_b_a, kMotion), 0.005);
}

TEST(RefineMotion, ConvergesToTheMinimumAndIgnoresWhatItMayNotUse) {
  auto pairs = makePairs(40, 20, 0, 9);
  std::vector<char> use(60, 0);
  std::fill(use.begin(), use.begin() + 40, 1);
  const Eigen::Isometry3d start =
      exp((Vector6d() << 0.03, -0.02, 0.05, 0.01, 0.01, -0.01).finished()) * kMotion;
  EXPECT_LT(apart(refineMotion(start, pairs, use, kWhitened, 5, 30), kMotion), 1e-6);
  EXPECT_EQ(refineMotion(start, pairs, use, kWhitened, 5, 0).matrix(), start.matrix());
}

}  // namespace
}  // namespace mvo
