// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Both solvers of Eq. (2): against exhaustive search, against the relaxation's lower bound, and in
// degenerate cases.
#include "engine/assignment/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "engine/assignment/coral.hpp"
#include "support/labelling_problems.hpp"

namespace mvo {
namespace {

using test::exhaustiveMinimum;
using test::randomAssignment;
using test::randomEnergy;
using test::RandomProblem;
using test::sceneProblem;
using test::SceneProblem;

constexpr double kRounding = 1e-9;
const std::vector<double> kLabelCosts{0, 2, 10, 40};
const std::vector<double> kSmoothness{0, 1, 4};

SceneProblem paperScene() {
  SceneProblem problem;
  problem.label_cost = 1000;
  problem.smoothness = 1;
  problem.outlier_scale = 100;
  problem.outlier_decay = 2;
  return problem;
}

class Assignment : public testing::TestWithParam<Solver> {
 protected:
  static std::vector<int> solve(const Energy& energy, std::vector<int> start) {
    if (GetParam() == Solver::kCoral) return relaxLabels(energy, std::move(start), CoralOptions());
    return expandLabels(energy, std::move(start));
  }
};

TEST_P(Assignment, IsMostlyTheOptimum) {
  // Measured on 600 problems per setting: alpha-expansion 98.3 % at worst and within a factor of
  // 1.07; on 150, the relaxation 99.3 % and 1.01 (its tolerance stops some just above the optimum).
  std::mt19937 random(1);
  int problems = 0;
  int optimal = 0;
  for (const double label_cost : kLabelCosts)
    for (const double smoothness : kSmoothness)
      for (int i = 0; i < 30; ++i, ++problems) {
        RandomProblem problem;
        problem.label_cost = label_cost;
        problem.smoothness = smoothness;
        const Energy energy = randomEnergy(problem, random);
        const double least = exhaustiveMinimum(energy);
        const double found = energy.evaluate(solve(energy, randomAssignment(energy, random)));
        ASSERT_GE(found, least - kRounding);
        ASSERT_LE(found, 1.1 * least);
        if (found <= least + kRounding) ++optimal;
      }
  EXPECT_GE(optimal, 0.98 * problems);
}

TEST_P(Assignment, NeverRaisesTheEnergy) {
  std::mt19937 random(2);
  for (int i = 0; i < 300; ++i) {
    RandomProblem problem;
    problem.tracklets = 40;
    problem.labels = 6;
    problem.label_cost = kLabelCosts[i % 4];
    problem.smoothness = kSmoothness[i % 3];
    problem.inadmissible = 0.3;
    const Energy energy = randomEnergy(problem, random);
    std::vector<int> labels = randomAssignment(energy, random);
    for (int pass = 0; pass < 2; ++pass) {
      const double before = energy.evaluate(labels);
      labels = solve(energy, labels);
      ASSERT_LE(energy.evaluate(labels), before);
    }
  }
}

TEST_P(Assignment, SolvesAScene) {
  // The lower bound proves both solvers right here, from any start.
  for (SceneProblem problem : {SceneProblem(), paperScene()}) {
    problem.tracklets = 300;
    const Energy energy = sceneProblem(problem, 4).energy;
    std::mt19937 random(6);
    const std::vector<int> outliers(energy.tracklets(), energy.outlier());
    CoralOptions accurate;
    accurate.tolerance = 1e-6;
    const double bound = solveRelaxation(energy, outliers, accurate).lower_bound;
    for (const auto& start : {outliers, randomAssignment(energy, random)}) {
      const double found = energy.evaluate(solve(energy, start));
      EXPECT_GE(found, bound - kRounding);
      EXPECT_LE(found, bound * (1 + 5e-4));
    }
  }
}

TEST_P(Assignment, FindsTheBodiesOfAScene) {
  const auto [energy, truth] = sceneProblem(SceneProblem(), 5);
  const std::vector<int> start(energy.tracklets(), energy.outlier());
  const std::vector<int> labels = solve(energy, start);
  int right = 0;
  for (std::size_t p = 0; p < truth.size(); ++p)
    if (labels[p] == truth[p]) ++right;
  EXPECT_GE(right, 0.98 * energy.tracklets());
}

TEST_P(Assignment, IsDeterministic) {
  const Energy energy = sceneProblem(paperScene(), 7).energy;
  std::mt19937 random(7);
  const std::vector<int> start = randomAssignment(energy, random);
  EXPECT_EQ(solve(energy, start), solve(energy, start));
}

TEST_P(Assignment, HasNoUnit) {
  std::mt19937 random(8);
  for (int i = 0; i < 50; ++i) {
    RandomProblem problem;
    problem.label_cost = kLabelCosts[i % 4];
    problem.inadmissible = 0;
    const Energy energy = randomEnergy(problem, random);
    Energy scaled = energy;
    scaled.data *= 128;  // a power of two: the same bits
    scaled.label_cost *= 128;
    for (auto& edge : scaled.edges) edge.weight *= 128;
    const std::vector<int> start = randomAssignment(energy, random);
    ASSERT_EQ(solve(energy, start), solve(scaled, start));
  }
}

TEST_P(Assignment, WithoutEdgesAndLabelCostsEachTakesItsBest) {
  std::mt19937 random(9);
  RandomProblem problem;
  problem.tracklets = 50;
  problem.labels = 5;
  problem.smoothness = 0;
  Energy energy = randomEnergy(problem, random);
  for (const bool keep_edges : {true, false}) {  // of weight 0
    if (!keep_edges) energy.edges.clear();
    const std::vector<int> labels = solve(energy, randomAssignment(energy, random));
    for (int p = 0; p < energy.tracklets(); ++p) {
      int best = -1;
      energy.data.row(p).minCoeff(&best);
      EXPECT_EQ(labels[p], best);
    }
  }
}

TEST_P(Assignment, AcceptsAnEmptyWindow) {
  Energy energy;
  energy.data.resize(0, 4);
  energy.label_cost = Eigen::Vector4d(1, 1, 1, 0);
  EXPECT_TRUE(solve(energy, {}).empty());
}

TEST_P(Assignment, WithoutLabelsAllAreOutliers) {
  std::mt19937 random(10);
  RandomProblem problem;
  problem.labels = 0;
  const Energy energy = randomEnergy(problem, random);
  EXPECT_EQ(solve(energy, std::vector<int>(7, 0)), std::vector<int>(7, 0));
}

TEST_P(Assignment, PaysALabelOnlyIfItSavesMore) {
  Energy energy;  // one label saves 3 x 5
  energy.data.resize(3, 2);
  energy.data << 1, 6, 1, 6, 1, 6;
  energy.label_cost = Eigen::Vector2d(14.9, 0);
  const std::vector<int> labelled(3, 0);
  const std::vector<int> outliers(3, 1);
  EXPECT_EQ(solve(energy, outliers), labelled);
  EXPECT_EQ(solve(energy, labelled), labelled);
  energy.label_cost[0] = 15.1;
  EXPECT_EQ(solve(energy, outliers), outliers);
  EXPECT_EQ(solve(energy, labelled), outliers);
}

TEST_P(Assignment, SharesOutALabelAmongTwoOthers) {
  // Label 2 saves its four tracklets 1 each and costs 5; no single expansion empties it.
  Energy energy;
  energy.data.resize(8, 4);
  energy.data << 0, 9, 9, 20,  //
      0, 9, 9, 20,             //
      9, 0, 9, 20,             //
      9, 0, 9, 20,             //
      2, 10, 1, 20,            //
      2, 10, 1, 20,            //
      10, 2, 1, 20,            //
      10, 2, 1, 20;
  energy.label_cost = Eigen::Vector4d(5, 5, 5, 0);
  EXPECT_EQ(solve(energy, {0, 0, 1, 1, 2, 2, 2, 2}), (std::vector<int>{0, 0, 1, 1, 0, 0, 1, 1}));
}

TEST_P(Assignment, AvoidsTheInadmissible) {
  std::mt19937 random(11);
  for (int i = 0; i < 60; ++i) {
    RandomProblem problem;
    problem.tracklets = 30;
    problem.smoothness = i % 3 == 0 ? 1e6 : 10;
    problem.label_cost = i % 2 == 0 ? 0 : 1e7;
    problem.inadmissible = 0.8;
    const Energy energy = randomEnergy(problem, random);
    const std::vector<int> labels = solve(energy, randomAssignment(energy, random));
    for (int p = 0; p < energy.tracklets(); ++p)
      ASSERT_LT(energy.data(p, labels[p]), Energy::kInadmissible);
  }
}

TEST_P(Assignment, SurvivesATrackletThatNothingAdmits) {
  Energy energy;
  energy.data.resize(2, 3);
  energy.data << Energy::kInadmissible, Energy::kInadmissible, Energy::kInadmissible, 1, 2, 3;
  energy.edges = {{0, 1, 1}};
  energy.label_cost = Eigen::Vector3d(0.5, 0.5, 0);
  EXPECT_EQ(solve(energy, {2, 2}), (std::vector<int>{0, 0}));
}

TEST_P(Assignment, IgnoresLoops) {
  Energy energy;
  energy.data.resize(1, 2);
  energy.data << 1, 2;
  energy.edges = {{0, 0, 100}};
  energy.label_cost = Eigen::Vector2d::Zero();
  EXPECT_EQ(solve(energy, {1}), std::vector<int>{0});
}

INSTANTIATE_TEST_SUITE_P(Solvers, Assignment,
                         testing::Values(Solver::kAlphaExpansion, Solver::kCoral),
                         [](const testing::TestParamInfo<Solver>& solver) {
                           return std::string(solver.param == Solver::kCoral ? "Coral"
                                                                             : "AlphaExpansion");
                         });

TEST(AlphaExpansion, IsExactForOneLabelAndOutliers) {
  // One label against the outlier label is a single minimum cut, with label costs too.
  std::mt19937 random(12);
  for (const double label_cost : kLabelCosts)
    for (const double smoothness : kSmoothness)
      for (int i = 0; i < 50; ++i) {
        RandomProblem problem;
        problem.tracklets = 9;
        problem.labels = 1;
        problem.label_cost = label_cost;
        problem.smoothness = smoothness;
        const Energy energy = randomEnergy(problem, random);
        const std::vector<int> labels = expandLabels(energy, randomAssignment(energy, random));
        ASSERT_NEAR(energy.evaluate(labels), exhaustiveMinimum(energy), kRounding);
      }
}

TEST(Coral, BoundsTheOptimumFromBelow) {
  std::mt19937 random(14);
  int tight = 0;
  int problems = 0;
  for (const double label_cost : kLabelCosts)
    for (const double smoothness : kSmoothness)
      for (int i = 0; i < 20; ++i, ++problems) {
        RandomProblem problem;
        problem.label_cost = label_cost;
        problem.smoothness = smoothness;
        const Energy energy = randomEnergy(problem, random);
        const std::vector<int> start = randomAssignment(energy, random);
        const double least = exhaustiveMinimum(energy);
        CoralOptions early;
        early.max_iterations = 3;
        ASSERT_LE(solveRelaxation(energy, start, early).lower_bound, least + kRounding);
        CoralOptions late;
        late.tolerance = 1e-6;
        late.max_iterations = 5000;
        const Relaxation relaxation = solveRelaxation(energy, start, late);
        ASSERT_LE(relaxation.lower_bound, least + kRounding);
        ASSERT_LE(relaxation.lower_bound, relaxation.objective + kRounding);
        ASSERT_DOUBLE_EQ(relaxation.energy, energy.evaluate(relaxation.assignment));
        if (relaxation.lower_bound > least * (1 - 1e-5)) ++tight;
      }
  EXPECT_GE(tight, 0.95 * problems);  // measured: 99 %
}

TEST(Coral, ConvergesToTheRelaxationsMinimum) {
  // Three tracklets in a triangle, three labels; each tracklet has one bad label. Sharing every
  // tracklet evenly between its good labels costs 3 x 0.5 smoothness, an integral assignment 2.
  Energy energy;
  energy.data.resize(3, 4);
  energy.data << 9, 0, 0, 9,  //
      0, 9, 0, 9,             //
      0, 0, 9, 9;
  energy.edges = {{0, 1, 1}, {1, 2, 1}, {0, 2, 1}};
  energy.label_cost = Eigen::Vector4d::Zero();
  CoralOptions accurate;
  accurate.tolerance = 1e-6;
  const Relaxation relaxation = solveRelaxation(energy, {3, 3, 3}, accurate);
  EXPECT_DOUBLE_EQ(exhaustiveMinimum(energy), 2);
  EXPECT_NEAR(relaxation.objective, 1.5, 1e-5);
  EXPECT_NEAR(relaxation.lower_bound, 1.5, 1e-5);
  EXPECT_DOUBLE_EQ(relaxation.energy, 2);
}

TEST(Coral, RoundsToAdmissibleLabelsHoweverEarly) {
  // Edges that outweigh inadmissibility, and no time to converge.
  std::mt19937 random(16);
  CoralOptions options;
  for (int i = 0; i < 200; ++i) {
    RandomProblem problem;
    problem.tracklets = 30;
    problem.smoothness = 100 * Energy::kInadmissible;
    problem.inadmissible = 0.5;
    const Energy energy = randomEnergy(problem, random);
    std::vector<int> start = randomAssignment(energy, random);
    for (int p = 0; p < energy.tracklets(); ++p)
      if (energy.data(p, start[p]) >= Energy::kInadmissible) start[p] = energy.outlier();
    options.max_iterations = 1 + i % 10;
    const std::vector<int> labels = relaxLabels(energy, start, options);
    for (int p = 0; p < energy.tracklets(); ++p)
      ASSERT_LT(energy.data(p, labels[p]), Energy::kInadmissible);
  }
}

TEST(Coral, StopsAtTheLimit) {
  const Energy energy = sceneProblem(SceneProblem(), 15).energy;
  const std::vector<int> start(energy.tracklets(), energy.outlier());
  CoralOptions options;
  options.tolerance = 1e-12;
  options.max_iterations = 7;
  EXPECT_EQ(solveRelaxation(energy, start, options).iterations, 7);
}

}  // namespace
}  // namespace mvo
