// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Minimum cuts by hand and against all subsets.
#include "engine/assignment/minimum_cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace mvo {
namespace {

constexpr int kSource = MinimumCut::kSource;
constexpr int kSink = MinimumCut::kSink;

TEST(MinimumCut, CutsTheWeakestLink) {
  MinimumCut problem(5);  // source -5-> 2 -1-> 3 -4-> 4 -3-> sink
  problem.add(kSource, 2, 5);
  problem.add(2, 3, 1);
  problem.add(3, 4, 4);
  problem.add(4, kSink, 3);
  EXPECT_EQ(problem.solve(), (std::vector<char>{1, 0, 1, 0, 0}));
}

TEST(MinimumCut, TiesGoToTheSink) {
  MinimumCut problem(3);
  problem.add(kSource, 2, 1.5);
  problem.add(2, kSink, 1.5);
  EXPECT_EQ(problem.solve(), (std::vector<char>{1, 0, 0}));
}

TEST(MinimumCut, LeavesIsolatedVerticesToTheSink) {
  EXPECT_EQ(MinimumCut(4).solve(), (std::vector<char>{1, 0, 0, 0}));
}

TEST(MinimumCut, IsTheLeastOfAllCuts) {
  constexpr int kInner = 7;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int round = 0; round < 200; ++round) {
    MinimumCut problem(kInner + 2);
    std::vector<std::vector<double>> capacity(kInner + 2, std::vector<double>(kInner + 2, 0));
    for (int a = 0; a < kInner + 2; ++a)
      for (int b = std::max(a + 1, 2); b < kInner + 2; ++b) {
        if (uniform(random) > 0.6) continue;
        // Arcs into the source and out of the sink have no use.
        capacity[a][b] = a == kSink ? 0 : uniform(random);
        capacity[b][a] = a == kSource ? 0 : uniform(random);
        problem.add(a, b, capacity[a][b], capacity[b][a]);
      }
    const auto cost = [&](const std::vector<char>& side) {
      double sum = 0;
      for (int a = 0; a < kInner + 2; ++a)
        for (int b = 0; b < kInner + 2; ++b)
          if (side[a] && !side[b]) sum += capacity[a][b];
      return sum;
    };
    const std::vector<char> solution = problem.solve();
    ASSERT_TRUE(solution[kSource]);
    ASSERT_FALSE(solution[kSink]);
    for (int subset = 0; subset < 1 << kInner; ++subset) {
      std::vector<char> side(kInner + 2, 0);
      side[kSource] = 1;
      for (int v = 0; v < kInner; ++v) side[v + 2] = static_cast<char>(subset >> v & 1);
      ASSERT_LE(cost(solution), cost(side) + 1e-12);
    }
  }
}

}  // namespace
}  // namespace mvo
