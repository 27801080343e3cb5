// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A single expansion move against all subsets.
#include "engine/assignment/expansion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "support/labelling_problems.hpp"

namespace mvo {
namespace {

constexpr double kRounding = 1e-9;

// The least energy of all expansions of alpha.
double exhaustiveExpansion(const Energy& energy, const std::vector<int>& f, int alpha) {
  double best = energy.evaluate(f);
  for (unsigned subset = 0; subset < 1u << f.size(); ++subset) {
    std::vector<int> g = f;
    for (std::size_t p = 0; p < f.size(); ++p)
      if (subset >> p & 1) g[p] = alpha;
    best = std::min(best, energy.evaluate(g));
  }
  return best;
}

TEST(Expansion, IsTheBestOfAll) {
  std::mt19937 random(1);
  int lowered = 0;
  int kept = 0;
  for (int i = 0; i < 2000; ++i) {
    test::RandomProblem problem;
    problem.tracklets = 8;
    problem.labels = 1 + i % 3;
    problem.smoothness = i % 5;
    Energy energy = test::randomEnergy(problem, random);
    std::uniform_real_distribution<double> cost(0, i % 2 == 0 ? 10 : 40);
    for (int l = 0; l < energy.outlier(); ++l) energy.label_cost[l] = cost(random);
    // Two labels at most, so that whole labels are at stake.
    std::vector<int> f = test::randomAssignment(energy, random);
    const int alpha = f[0];
    for (int& l : f) l = l % 2 == 0 ? f[1] : f[2];

    const double least = exhaustiveExpansion(energy, f, alpha);
    const double value = energy.evaluate(f);
    const auto expanded = Expansions(energy).best(f, alpha);
    if (least < value - kRounding) {
      ASSERT_TRUE(expanded);
      ASSERT_NEAR(energy.evaluate(*expanded), least, kRounding);
      ++lowered;
    } else {
      ++kept;
    }
    if (!expanded) continue;
    for (std::size_t p = 0; p < f.size(); ++p)
      ASSERT_TRUE((*expanded)[p] == f[p] || (*expanded)[p] == alpha);
  }
  EXPECT_GT(lowered, 300);
  EXPECT_GT(kept, 300);
}

TEST(Expansion, EmptiesALabelTogether) {
  // Each tracklet loses 2 by leaving label 0, two edges of 1 tie them, and leaving together
  // saves 7.
  Energy energy;
  energy.data.resize(3, 2);
  energy.data << 0, 2, 0, 2, 0, 2;
  energy.edges = {{0, 1, 1}, {1, 2, 1}};
  energy.label_cost = Eigen::Vector2d(7, 0);
  EXPECT_EQ(Expansions(energy).best({0, 0, 0}, 1), (std::vector<int>{1, 1, 1}));
  energy.label_cost[0] = 5;
  EXPECT_FALSE(Expansions(energy).best({0, 0, 0}, 1));
}

TEST(Expansion, EmptiesTwoLabelsTogether) {
  // Both lose 5, the edge between them saves 4 if both leave and their labels save 7.9; label 0
  // would never leave alone.
  Energy energy;
  energy.data.resize(2, 3);
  energy.data << 0, 20, 5, 20, 0, 5;
  energy.edges = {{0, 1, 4}};
  energy.label_cost = Eigen::Vector3d(2.9, 5, 0);
  EXPECT_EQ(Expansions(energy).best({0, 1}, 2), (std::vector<int>{2, 2}));
}

TEST(Expansion, OfTheOnlyLabelChangesNothing) {
  Energy energy;
  energy.data = Eigen::MatrixXd::Ones(2, 2);
  energy.label_cost = Eigen::Vector2d(1, 0);
  EXPECT_FALSE(Expansions(energy).best({0, 0}, 0));
}

TEST(Expansion, DoesNotDependOnWhereItWasBefore) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    test::RandomProblem problem;
    problem.tracklets = 60;
    problem.label_cost = i % 2 == 0 ? 3 : 30;
    problem.smoothness = i % 5;
    const Energy energy = test::randomEnergy(problem, random);
    Expansions remembers(energy);
    std::vector<int> f = test::randomAssignment(energy, random);
    for (int move = 0; move < 20; ++move) {
      const int alpha = move % (energy.outlier() + 1);
      const auto expanded = remembers.best(f, alpha);
      ASSERT_EQ(expanded, Expansions(energy).best(f, alpha));
      if (expanded) f = *expanded;
      if (move % 3 == 0)
        f[random() % f.size()] = static_cast<int>(random() % (energy.outlier() + 1));
    }
  }
}

TEST(Neighborhood, KnowsEveryEdgeFromBothEnds) {
  Energy energy;
  energy.data.resize(4, 1);
  energy.edges = {{0, 2, 0.5}, {2, 1, 1.5}, {1, 1, 9}, {0, 1, 0}};
  const Neighborhood neighborhood(energy);
  const auto at = [&](int p) {
    std::vector<std::pair<int, double>> list;
    for (const auto& q : neighborhood.of(p)) list.emplace_back(q.tracklet, q.weight);
    return list;
  };
  using List = std::vector<std::pair<int, double>>;
  EXPECT_EQ(at(0), (List{{2, 0.5}}));
  EXPECT_EQ(at(1), (List{{2, 1.5}}));
  EXPECT_EQ(at(2), (List{{0, 0.5}, {1, 1.5}}));
  EXPECT_EQ(at(3), List{});
}

}  // namespace
}  // namespace mvo
