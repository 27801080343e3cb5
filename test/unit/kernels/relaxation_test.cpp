// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The relaxation's iteration: what is projected is feasible, and costs are what prices add up to.
#include "kernels/relaxation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "support/halves.hpp"

namespace mvo {
namespace {

constexpr double kRounding = 1e-9;

// Random shares and prices of 10 tracklets, 6 labels and 9 edges.
struct RandomPoint {
  static constexpr int kWidth = 8;
  static constexpr int kTracklets = 10;
  static constexpr int kEdges = 9;

  explicit RandomPoint(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (auto* array : {&rho, &u, &extrapolated, &z, &cost}) array->assign(12 * kWidth, 0);
    y.assign(kEdges * kWidth, 0);
    for (int p = 0; p < 12; ++p)
      for (int l = 0; l < kWidth; ++l) {
        rho[p * kWidth + l] = l < 6 ? 10 * uniform(random) : 1e30;
        cost[p * kWidth + l] = rho[p * kWidth + l];
      }
    for (int p = 0; p < 12; ++p) u[p * kWidth + static_cast<int>(random() % 6)] = 1;
    for (int e = 0; e < kEdges; ++e) {
      ends.insert(ends.end(), {e, e + 1});
      half_weight.push_back(uniform(random));
    }
    point.width = kWidth;
    point.tracklets = kTracklets;
    point.edges = kEdges;
    point.ends = ends.data();
    point.half_weight = half_weight.data();
    point.gamma = gamma.data();
    point.rho = rho.data();
    point.step = step.data();
    point.u = u.data();
    point.extrapolated = extrapolated.data();
    point.y = y.data();
    point.z = z.data();
    point.level = level.data();
    point.cost = cost.data();
    point.scratch = scratch.data();
  }

  std::vector<int> ends;
  std::vector<double> half_weight, rho, u, extrapolated, y, z, cost;
  std::vector<double> gamma = {0, 1, 2, 0.5, 3, 1, 0, 0};
  std::vector<double> step = std::vector<double>(12, 0.2);
  std::vector<double> level = std::vector<double>(kWidth, 0);
  std::vector<double> scratch = std::vector<double>(kWidth * kDoubles);
  SaddlePoint point;
};

using RelaxationKernels = test::BothHalves;

TEST_P(RelaxationKernels, StayFeasible) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    RandomPoint a(seed);
    for (int i = 0; i < 30; ++i) {
      descendShares(a.point);
      ascendPrices(a.point, 1.5);
    }

    constexpr int kWidth = RandomPoint::kWidth;
    std::vector<double> cost = a.rho;
    for (int p = 0; p < RandomPoint::kTracklets; ++p) {
      double sum = 0;
      for (int l = 0; l < kWidth; ++l) {
        ASSERT_GE(a.u[p * kWidth + l], 0);
        ASSERT_TRUE(l < 6 || a.u[p * kWidth + l] == 0);
        sum += a.u[p * kWidth + l];
        cost[p * kWidth + l] += a.z[p * kWidth + l];
      }
      ASSERT_NEAR(sum, 1, kRounding);
    }
    for (int e = 0; e < RandomPoint::kEdges; ++e)
      for (int l = 0; l < kWidth; ++l) {
        ASSERT_LE(std::abs(a.y[e * kWidth + l]), a.half_weight[e]);
        cost[e * kWidth + l] += a.y[e * kWidth + l];
        cost[(e + 1) * kWidth + l] -= a.y[e * kWidth + l];
      }
    for (int i = 0; i < RandomPoint::kTracklets * kWidth; ++i)
      ASSERT_NEAR(a.cost[i] / cost[i], 1, kRounding);
    for (int l = 0; l < kWidth; ++l) {
      double sum = 0;
      for (int p = 0; p < RandomPoint::kTracklets; ++p) {
        ASSERT_GE(a.z[p * kWidth + l], 0);
        sum += a.z[p * kWidth + l];
      }
      ASSERT_LE(sum, a.gamma[l] + kRounding);
    }
  }
}

TEST(RelaxationKernelBits, AreTheSameOnBothHalves) {
  test::expectSameBitsOnBothHalves([] {
    std::vector<double> outputs;
    for (unsigned seed = 0; seed < 20; ++seed) {
      RandomPoint a(seed);
      for (int i = 0; i < 30; ++i) {
        descendShares(a.point);
        ascendPrices(a.point, 0.3 + 0.1 * seed);
      }
      for (const auto* array : {&a.u, &a.extrapolated, &a.y, &a.z, &a.level, &a.cost})
        outputs.insert(outputs.end(), array->begin(), array->end());
    }
    return outputs;
  });
}

INSTANTIATE_TEST_SUITE_P(Halves, RelaxationKernels,
                         testing::Values(Half::kPortable, Half::kMachine, Half::kTwoRoundings),
                         test::nameOfHalf);

}  // namespace
}  // namespace mvo
