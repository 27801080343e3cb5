// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C's time and energy on windows of 250 to 4000 tracklets, with about three edges each, and 5
// to 20 labels: cold (all outliers) and warm (the true labels but for 2 % of the tracklets), for
// the default and the paper's constants.
#include <benchmark/benchmark.h>

#include <map>
#include <tuple>

#include "engine/assignment/assignment.hpp"
#include "engine/assignment/coral.hpp"
#include "support/labelling_problems.hpp"

namespace mvo {
namespace {

struct Case {
  test::Scene scene;
  double lower_bound;  // of the energy
};

// Neighbourhoods of large windows take longer than solving them, so each is made once.
const Case& problemOf(int tracklets, int labels, bool paper) {
  static std::map<std::tuple<int, int, bool>, Case> cases;
  const auto [it, made] = cases.try_emplace({tracklets, labels, paper});
  if (!made) return it->second;
  test::SceneProblem problem;
  problem.tracklets = tracklets;
  problem.duplicates = labels / 5 - 1;
  if (paper) {
    problem.label_cost = 1000;
    problem.smoothness = 1;
    problem.outlier_scale = 100;
    problem.outlier_decay = 2;
  }
  it->second.scene = test::sceneProblem(problem, 1);
  const Energy& energy = it->second.scene.energy;
  it->second.lower_bound =
      solveRelaxation(energy, std::vector<int>(tracklets, energy.outlier()), {}).lower_bound;
  return it->second;
}

void assign(benchmark::State& state, Solver solver) {
  const Case& c = problemOf(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                            state.range(3) != 0);
  const Energy& energy = c.scene.energy;
  std::vector<int> start(c.scene.truth.size(), energy.outlier());
  if (state.range(2) != 0) {
    std::mt19937 random(1);
    start = c.scene.truth;
    for (std::size_t p = 0; p < start.size(); p += 50)
      start[p] = static_cast<int>(random() % (energy.outlier() + 1));
  }
  std::vector<int> labels;
  for (auto _ : state) {
    labels = solver == Solver::kCoral ? relaxLabels(energy, start, CoralOptions())
                                      : expandLabels(energy, start);
    benchmark::DoNotOptimize(labels);
  }
  state.counters["edges"] = static_cast<double>(energy.edges.size());
  state.counters["energy"] = energy.evaluate(labels);
  state.counters["bound"] = c.lower_bound;
}

const std::vector<std::vector<std::int64_t>> kProblems{
    {250, 1000, 4000}, {5, 10, 20}, {0, 1}, {0, 1}};

BENCHMARK_CAPTURE(assign, alpha_expansion, Solver::kAlphaExpansion)
    ->ArgNames({"tracklets", "labels", "warm", "paper"})
    ->ArgsProduct(kProblems)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assign, coral, Solver::kCoral)
    ->ArgNames({"tracklets", "labels", "warm", "paper"})
    ->ArgsProduct(kProblems)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mvo
