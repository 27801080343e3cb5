// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The time of what is done to labels between the solver and the batch, on windows that are
// segmented already: merging (III-D), sanitizing (III-E), identities over time, and carrying labels
// on to a new frame.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "engine/graph/graph.hpp"
#include "engine/merging.hpp"
#include "engine/proposal.hpp"
#include "engine/sanitization.hpp"
#include "support/window_of_motions.hpp"
#include "trajectories/label_continuity.hpp"

namespace mvo {
namespace {

// The true labels over a window.
struct Segmented {
  explicit Segmented(const benchmark::State& state) {
    cv::setNumThreads(1);
    const test::WindowSize size{static_cast<int>(state.range(0)), 48,
                                static_cast<int>(state.range(1))};
    const test::SyntheticWindow scene = test::sceneOfMotions(size, 0);
    window = scene.window;
    camera = scene.camera;
    graph = buildGraph(window, options.graph);
    for (int l = 0; l < size.motions; ++l) labels.labels.push_back({l, scene.trajectory(l), l, 0});
    labels.assignment = scene.truth;
  }

  Options options;
  Window window;
  StereoCamera camera;
  Graph graph;
  Labeling labels;
};

void merge(benchmark::State& state) {
  const Segmented s(state);
  ResidualCache residuals(s.window, s.camera, s.options.noise, s.options.energy);
  const ResidualTable table = residuals.table(s.labels.labels);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        mergeLabels(s.window, s.graph, table, s.labels, s.options.energy, MergeScope::kAdjacent));
}

void sanitize(benchmark::State& state) {
  const Segmented s(state);
  ResidualCache residuals(s.window, s.camera, s.options.noise, s.options.energy);
  for (auto _ : state)
    benchmark::DoNotOptimize(sanitizeLabels(s.window, s.graph, residuals, s.labels,
                                            s.options.energy, s.options.engine,
                                            s.options.proposal.min_support, true));
}

void continueIdentities(benchmark::State& state) {
  const Segmented s(state);
  LabelContinuity continuity;
  continuity.assign(s.window, s.labels, s.options.trajectory);
  for (auto _ : state)
    benchmark::DoNotOptimize(continuity.assign(s.window, s.labels, s.options.trajectory));
}

void extend(benchmark::State& state) {
  Segmented s(state);
  for (Label& label : s.labels.labels) {
    label.trajectory.T_ck_c1.pop_back();
    label.trajectory.segment.pop_back();
  }
  const LinkResidual residual(s.camera, s.options.noise, s.options.energy.residual);
  for (auto _ : state)
    benchmark::DoNotOptimize(extendLabels(s.window, residual, s.labels, s.options.proposal,
                                          s.options.bundle_adjustment.min_observations,
                                          s.options.seed));
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"tracklets", "motions"})->Unit(benchmark::kMicrosecond);
  for (const int tracklets : {250, 1000, 4000}) benchmark->Args({tracklets, 5});
  for (const int motions : {1, 10}) benchmark->Args({1000, motions});
}

BENCHMARK(extend)->Apply(cases);
BENCHMARK(merge)->Apply(cases);
BENCHMARK(sanitize)->Apply(cases);
BENCHMARK(continueIdentities)->Apply(cases);

}  // namespace
}  // namespace mvo
