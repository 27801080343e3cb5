// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The passes over a landmark's measurements. What they add up to is tested where they are put
// together, against the full normal equations (batch/bundle_internals_test.cpp).
#include "kernels/landmark.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

#include "support/halves.hpp"

namespace mvo {
namespace {

// A landmark seen in up to 4 * blocks poses, with everything that is measured and summed.
struct RandomLandmark {
  explicit RandomLandmark(unsigned seed, std::size_t blocks)
      : measurements(blocks), coupling(blocks * kCouplingPerBlock) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const std::size_t poses = blocks * kDoubles;
    pose_rows.reset(kPoseRows, poses);
    sum_rows.reset(kSumRows, poses);
    for (std::size_t k = 0; k < poses; ++k)
      for (std::size_t row = 0; row < kPoseRows; ++row)
        pose_rows(row, k) = (row == 0 || row == 4 || row == 8 ? 1 : 0) + 0.1 * uniform(random);
    for (double& value : of.B) value = uniform(random);
    of.gain = {500 / 0.15, 510 / 0.15, 120 / 0.2};
    of.inverse_square_scale = seed % 3 == 0 ? 0 : 0.1;
    of.origin = {0.1 * uniform(random), 0.1 * uniform(random), 1};
    // Some pass behind the camera.
    of.m = {0.2 * uniform(random), 0.2 * uniform(random), seed % 5 == 0 ? 9 : 0.3};
    for (MeasurementBlock& block : measurements)
      for (std::size_t lane = 0; lane < kDoubles; ++lane) {
        block.u[lane] = 900 * uniform(random);
        block.v[lane] = 900 * uniform(random);
        block.d[lane] = 180 + 20 * uniform(random);
        block.seen[lane] = uniform(random) < 0.7 ? 1 : 0;
      }
    of.blocks = measurements.data();
    of.count = blocks;
  }

  std::vector<MeasurementBlock> measurements;
  std::vector<double> coupling;
  PoseTable pose_rows;
  PoseTable sum_rows;
  LandmarkMeasurements of{};
};

void keep(const ResidualSums& sums, std::vector<double>& outputs) {
  outputs.insert(outputs.end(), sums.squares.begin(), sums.squares.end());
  outputs.insert(outputs.end(), sums.excess.begin(), sums.excess.end());
  outputs.push_back(sums.logarithms);
}

TEST(LandmarkKernels, CountTheSameResidualsInBothPasses) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    RandomLandmark landmark(seed, 1 + seed % 4);
    ResidualSums alone;
    ResidualSums linearized;
    addResiduals(landmark.of, landmark.pose_rows.at(0), landmark.pose_rows.stride(), alone);
    linearizeLandmark(landmark.of, landmark.pose_rows.at(0), landmark.pose_rows.stride(),
                      landmark.sum_rows.at(0), landmark.coupling.data(), linearized);
    EXPECT_NEAR(alone.totalSquares(), linearized.totalSquares(), 1e-9 * alone.totalSquares());
    EXPECT_NEAR(alone.totalLogarithms(), linearized.totalLogarithms(),
                1e-9 * alone.totalLogarithms());
  }
}

TEST(LandmarkKernelBits, AreTheSameOnBothHalves) {
  test::expectSameBitsOnBothHalves([] {
    std::vector<double> outputs;
    for (unsigned seed = 0; seed < 200; ++seed) {
      const std::size_t blocks = 1 + seed % 5;
      RandomLandmark landmark(seed, blocks);
      const std::size_t stride = landmark.pose_rows.stride();
      ResidualSums sums;
      addResiduals(landmark.of, landmark.pose_rows.at(0), stride, sums);
      const LandmarkTerms terms =
          linearizeLandmark(landmark.of, landmark.pose_rows.at(0), stride, landmark.sum_rows.at(0),
                            landmark.coupling.data(), sums);
      keep(sums, outputs);
      outputs.insert(outputs.end(), terms.V.begin(), terms.V.end());
      outputs.insert(outputs.end(), terms.g.begin(), terms.g.end());
      outputs.insert(outputs.end(), landmark.sum_rows.at(0),
                     landmark.sum_rows.at(0) + kSumRows * stride);
      outputs.insert(outputs.end(), landmark.coupling.begin(), landmark.coupling.end());
      const std::size_t rows = 6 * blocks * kDoubles;
      std::vector<double> U(3 * rows, 0.0);
      writeFactor(landmark.coupling.data(), blocks, {1.2, 0.3, 0.9, -0.4, 0.2, 1.1}, U.data(),
                  rows);
      outputs.insert(outputs.end(), U.begin(), U.end());
    }
    return outputs;
  });
}

}  // namespace
}  // namespace mvo
