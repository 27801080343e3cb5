// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Residuals of many pairs at once against those of one at a time.
#include "kernels/frame_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "mvo/se3.hpp"
#include "support/halves.hpp"
#include "support/stereo_pairs.hpp"

namespace mvo {
namespace {

using test::somePairs;

const StereoCamera& kCamera = test::kPairCamera;
const Eigen::Isometry3d& kMotion = test::kPairMotion;
constexpr float kThreshold = 1.5;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

double scoreOneByOne(const std::vector<StereoPair>& pairs, const LinkResidual& residual,
                     const Eigen::Isometry3d& T_b_a, Ranking ranking) {
  double sum = 0;
  for (const StereoPair& pair : pairs) {
    const double e = residual(T_b_a, pair.y_a, pair.y_b) / kThreshold;
    sum += ranking == Ranking::kCount ? (e < 1 ? 0 : 1) : std::min(e * e, 1.0);
  }
  return sum;
}

using PairArraysOfBothHalves = test::BothHalves;

TEST_P(PairArraysOfBothHalves, AgreeWithTheResidualOfOnePair) {
  const Eigen::Isometry3d backwards = exp((Vector6d() << 0, 0, -0.2, 0, 0, 0).finished()) * kMotion;
  for (const ResidualModel model : {ResidualModel::kWhitened, ResidualModel::kImageDistance})
    for (const int n : {1, 3, 7, 8, 9, 40, 203}) {
      const LinkResidual residual(kCamera, {}, model);
      const auto pairs = somePairs(n);
      const PairArrays arrays(pairs, residual);
      for (const Eigen::Isometry3d& T : {kMotion, backwards}) {
        for (const Ranking ranking : {Ranking::kMsac, Ranking::kCount})
          EXPECT_NEAR(arrays.score(T, ranking, kThreshold, kInfinity),
                      scoreOneByOne(pairs, residual, T, ranking), 1e-3)
              << n;
        const std::vector<char> inlier = arrays.inliers(T, kThreshold);
        ASSERT_EQ(inlier.size(), pairs.size());
        for (int i = 0; i < n; ++i)
          EXPECT_EQ(inlier[i] != 0, residual(T, pairs[i].y_a, pairs[i].y_b) < kThreshold) << i;
      }
    }
}

TEST_P(PairArraysOfBothHalves, GiveUpOnceTheBestCannotBeReached) {
  const LinkResidual residual(kCamera, {}, ResidualModel::kWhitened);
  const PairArrays arrays(somePairs(100), residual);
  const float score = arrays.score(kMotion, Ranking::kMsac, kThreshold, kInfinity);
  ASSERT_TRUE(std::isfinite(score));
  EXPECT_EQ(arrays.score(kMotion, Ranking::kMsac, kThreshold, score + 0.01F), score);
  EXPECT_EQ(arrays.score(kMotion, Ranking::kMsac, kThreshold, score - 0.01F), kInfinity);
}

TEST_P(PairArraysOfBothHalves, OfNoPairs) {
  const PairArrays arrays({}, LinkResidual(kCamera, {}, ResidualModel::kWhitened));
  EXPECT_EQ(arrays.score(kMotion, Ranking::kMsac, kThreshold, kInfinity), 0);
  EXPECT_TRUE(arrays.inliers(kMotion, kThreshold).empty());
}

TEST(PairArrayBits, AreTheSameOnBothHalves) {
  test::expectSameBitsOnBothHalves([] {
    std::vector<double> outputs;
    for (const ResidualModel model : {ResidualModel::kWhitened, ResidualModel::kImageDistance})
      for (int n = 1; n < 200; ++n) {
        const PairArrays arrays(somePairs(n), LinkResidual(kCamera, {}, model));
        for (const Ranking ranking : {Ranking::kMsac, Ranking::kCount})
          outputs.push_back(arrays.score(kMotion, ranking, kThreshold, kInfinity));
        for (const char inlier : arrays.inliers(kMotion, kThreshold)) outputs.push_back(inlier);
      }
    return outputs;
  });
}

INSTANTIATE_TEST_SUITE_P(Halves, PairArraysOfBothHalves,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

}  // namespace
}  // namespace mvo
