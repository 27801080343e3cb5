// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F's time: a window's static label (48 poses, 1000 landmarks) and a body's (100 landmarks),
// one iteration and a warm start, per back end and number of threads.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "engine/batch/bundle_adjustment.hpp"
#include "support/bundle_scene.hpp"

namespace mvo {
namespace {

test::BundleScene scene(int points) {
  test::SceneOptions with;
  with.frames = 48;
  with.points = points;
  with.min_length = points > 200 ? 2 : 20;  // few tracklets must be long, to be seen in each frame
  with.max_length = points > 200 ? 32 : 48;
  with.shake = 0.02;
  return test::makeBundleScene(with);
}

void adjust(benchmark::State& state, BundleAdjustmentOptions options, int points, int iterations) {
  const test::BundleScene problem = scene(points);
  BatchSummary summary;
  for (auto _ : state) {
    state.PauseTiming();
    test::Batch batch = problem.start;
    state.ResumeTiming();
    summary = test::adjustBundle(batch, problem.camera, problem.noise, options, iterations);
    benchmark::DoNotOptimize(summary);
  }
  std::size_t observations = 0;
  for (const auto& landmark : problem.start.landmarks) observations += landmark.observations.size();
  state.counters["observations"] = static_cast<double>(observations);
  state.counters["iterations"] = summary.iterations;
  state.counters["cost"] = summary.final_cost;
}

void oneIteration(benchmark::State& state) {
  BundleAdjustmentOptions options;
  options.backend = static_cast<BatchBackend>(state.range(0));
  cv::setNumThreads(static_cast<int>(state.range(1)));
  options.function_tolerance = 0;
  adjust(state, options, static_cast<int>(state.range(2)), 1);
}

void fiveIterations(benchmark::State& state) {
  BundleAdjustmentOptions options;
  options.backend = static_cast<BatchBackend>(state.range(0));
  cv::setNumThreads(static_cast<int>(state.range(1)));
  options.function_tolerance = 0;
  adjust(state, options, static_cast<int>(state.range(2)), 5);
}

void warmStart(benchmark::State& state) {
  BundleAdjustmentOptions options;
  options.backend = static_cast<BatchBackend>(state.range(0));
  cv::setNumThreads(static_cast<int>(state.range(1)));
  adjust(state, options, static_cast<int>(state.range(2)), 10);
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"schur", "threads", "landmarks"});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int landmarks : {1000, 100})
    for (const int schur : {0, 1})
      for (const int threads : {1, 2}) benchmark->Args({schur, threads, landmarks});
}

BENCHMARK(oneIteration)->Apply(cases);
BENCHMARK(fiveIterations)->Apply(cases);
BENCHMARK(warmStart)->Apply(cases);

}  // namespace
}  // namespace mvo
