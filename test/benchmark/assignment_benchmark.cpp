// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-C's time on a window of 1000 tracklets, 3000 edges and 5 or 10 labels: cold (all outliers)
// and warm (the true labels but for 2 % of the tracklets), for the default and the paper's
// constants.
#include <benchmark/benchmark.h>

#include "mvo/engine/assignment.hpp"
#include "support/labelling_problems.hpp"

namespace mvo {
namespace {

void assign(benchmark::State& state, Solver solver) {
  test::SceneProblem problem;
  problem.duplicates = static_cast<int>(state.range(0)) / 5 - 1;
  if (state.range(2) != 0) {
    problem.label_cost = 1000;
    problem.smoothness = 1;
    problem.outlier_scale = 100;
    problem.outlier_decay = 2;
  }
  const test::Scene scene = test::sceneProblem(problem, 1);
  const Energy& energy = scene.energy;
  std::vector<int> start(scene.truth.size(), energy.outlier());
  if (state.range(1) != 0) {
    std::mt19937 random(1);
    start = scene.truth;
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
}

BENCHMARK_CAPTURE(assign, alpha_expansion, Solver::kAlphaExpansion)
    ->ArgNames({"labels", "warm", "paper"})
    ->ArgsProduct({{5, 10}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(assign, coral, Solver::kCoral)
    ->ArgNames({"labels", "warm", "paper"})
    ->ArgsProduct({{5, 10}, {0, 1}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace mvo
