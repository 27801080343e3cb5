// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Labelling problems for the solvers' tests and benchmark: small random ones that exhaustive search
// can solve, and large ones shaped like a window of a scene with a few bodies.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "engine/energy.hpp"

namespace mvo::test {

struct RandomProblem {
  int tracklets = 7;
  int labels = 3;  ///< without the outlier label
  double label_cost = 0;
  double smoothness = 1;      ///< largest edge weight; residuals are in [0, 10)
  double inadmissible = 0.1;  ///< share of such entries; the outlier label is always admissible
};

/// Without structure: hard for local search.
inline Energy randomEnergy(const RandomProblem& problem, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0, 1);
  Energy energy;
  energy.data.resize(problem.tracklets, problem.labels + 1);
  for (int p = 0; p < problem.tracklets; ++p)
    for (int l = 0; l <= problem.labels; ++l)
      energy.data(p, l) = l < problem.labels && uniform(random) < problem.inadmissible
                              ? Energy::kInadmissible
                              : 10 * uniform(random);
  for (int p = 0; p < problem.tracklets; ++p)
    for (int q = p + 1; q < problem.tracklets; ++q)
      if (uniform(random) < 0.4)
        energy.edges.push_back({p, q, problem.smoothness * uniform(random)});
  energy.label_cost = Eigen::VectorXd::Constant(problem.labels + 1, problem.label_cost);
  energy.label_cost[problem.labels] = 0;
  return energy;
}

inline std::vector<int> randomAssignment(const Energy& energy, std::mt19937& random) {
  std::uniform_int_distribution<int> label(0, energy.outlier());
  std::vector<int> assignment(energy.tracklets());
  for (int& l : assignment) l = label(random);
  return assignment;
}

/// The least energy of all (L + 1)^N assignments.
inline double exhaustiveMinimum(const Energy& energy) {
  std::vector<int> assignment(energy.tracklets(), 0);
  double best = energy.evaluate(assignment);
  for (std::size_t p = 0; p < assignment.size();) {
    if (++assignment[p] > energy.outlier()) {
      assignment[p++] = 0;
      continue;
    }
    p = 0;
    best = std::min(best, energy.evaluate(assignment));
  }
  return best;
}

struct SceneProblem {
  int tracklets = 1000;
  int duplicates = 1;          ///< near copies of each of the five true labels
  double label_cost = 40;      ///< gamma
  double smoothness = 0.3;     ///< lambda
  double outlier_scale = 10;   ///< alpha
  double outlier_decay = 0.7;  ///< beta
};

struct Scene {
  Energy energy;
  std::vector<int> truth;
};

/// Points of a 640 x 480 image over a background and four discs, their 5-nearest-neighbour graph,
/// and residuals [px] as the true motions and slightly worse copies of them leave; 5 % of the
/// tracklets follow no motion.
inline Scene sceneProblem(const SceneProblem& problem, unsigned seed) {
  constexpr std::array<std::array<double, 3>, 4> kDiscs{
      {{120, 120, 60}, {450, 110, 45}, {200, 350, 80}, {520, 360, 35}}};
  constexpr int kBodies = 5;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> normal(0, 1);

  const int n = problem.tracklets;
  const int labels = kBodies * (1 + problem.duplicates);
  std::vector<std::array<double, 2>> points(n);
  std::vector<int> body(n, 0);
  Scene scene;
  scene.truth.assign(n, labels);
  for (int p = 0; p < n; ++p) {
    points[p] = {640 * uniform(random), 480 * uniform(random)};
    for (std::size_t d = 0; d < kDiscs.size(); ++d)
      if (std::hypot(points[p][0] - kDiscs[d][0], points[p][1] - kDiscs[d][1]) < kDiscs[d][2])
        body[p] = static_cast<int>(d) + 1;
    if (uniform(random) > 0.05) scene.truth[p] = body[p];
  }

  Energy& energy = scene.energy;
  energy.data.resize(n, labels + 1);
  for (int p = 0; p < n; ++p) {
    for (int l = 0; l < labels; ++l) {
      const bool own = l % kBodies == scene.truth[p];
      const double copy = l / kBodies;  // 0 for the true label
      const double motion = own ? 0 : 2 + 8 * uniform(random);
      energy.data(p, l) =
          std::max(0.0, motion + (0.4 + 0.4 * copy) * std::abs(normal(random)) - 0.6);
    }
    energy.data(p, labels) =
        problem.outlier_scale *
        std::exp(-energy.data.row(p).head(labels).minCoeff() / problem.outlier_decay);
  }
  std::vector<std::pair<int, int>> pairs;
  for (int p = 0; p < n; ++p) {
    std::vector<std::pair<double, int>> others;
    for (int q = 0; q < n; ++q)
      if (q != p)
        others.emplace_back(std::hypot(points[p][0] - points[q][0], points[p][1] - points[q][1]),
                            q);
    const int k = std::min<int>(5, static_cast<int>(others.size()));
    std::partial_sort(others.begin(), others.begin() + k, others.end());
    for (int i = 0; i < k; ++i) pairs.emplace_back(std::minmax(p, others[i].second));
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto& [p, q] : pairs) energy.edges.push_back({p, q, problem.smoothness});
  energy.label_cost = Eigen::VectorXd::Constant(labels + 1, problem.label_cost);
  energy.label_cost[labels] = 0;
  return scene;
}

}  // namespace mvo::test
