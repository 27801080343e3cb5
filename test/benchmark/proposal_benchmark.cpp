// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-B's time: cold, when all tracklets propose over all frames, and of labels that go on to the
// newest frame.
#include <benchmark/benchmark.h>

#include "engine/graph/graph.hpp"
#include "engine/proposal.hpp"
#include "support/benchmark_windows.hpp"

namespace mvo {
namespace {

void proposeCold(benchmark::State& state) {
  const test::SyntheticWindow scene = test::windowOf(state);
  const Options options;
  const Graph graph = buildGraph(scene.window, options.graph);
  const LinkResidual residual(scene.camera, options.noise, options.energy.residual);
  const Labeling labels = test::trueLabels(scene);
  for (auto _ : state) {
    ResidualCache residuals(scene.window, scene.camera, options.noise, options.energy);
    Proposer proposer(scene.window, graph, residual, options.proposal, options.energy.threshold,
                      options.seed, false);
    benchmark::DoNotOptimize(proposer.propose(labels, residuals));
  }
}
BENCHMARK(proposeCold)->Apply(test::windowSizes);

void extend(benchmark::State& state) {
  const test::SyntheticWindow scene = test::windowOf(state);
  const Options options;
  Labeling labels = test::trueLabels(scene);
  for (Label& label : labels.labels) {
    label.trajectory.T_ck_c1.pop_back();
    label.trajectory.segment.pop_back();
  }
  const LinkResidual residual(scene.camera, options.noise, options.energy.residual);
  for (auto _ : state)
    benchmark::DoNotOptimize(extendLabels(scene.window, residual, labels, options.proposal,
                                          options.bundle_adjustment.min_observations,
                                          options.seed));
}
BENCHMARK(extend)->Apply(test::windowSizes);

}  // namespace
}  // namespace mvo
