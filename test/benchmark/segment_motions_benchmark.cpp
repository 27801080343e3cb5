// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The engine's time (III-A to III-F) on synthetic windows: cold, and warm with one new frame.
#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "support/warm_starts.hpp"
#include "support/window_of_motions.hpp"

namespace mvo {
namespace {

void engine(benchmark::State& state, bool warm) {
  constexpr int kWarmUp = 4;
  const test::WindowSize size{static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                              static_cast<int>(state.range(2))};
  cv::setNumThreads(static_cast<int>(state.range(3)));
  const test::SyntheticWindow scene = test::sceneOfMotions(size, kWarmUp);
  Options options;
  options.window.frames = size.frames;
  test::WarmStarts starts;
  if (warm) {
    starts.remember(test::windowFrom(scene, 0, size), test::firstLabels(scene, size));
    for (int k = 0; k < kWarmUp; ++k) {
      const Window window = test::windowFrom(scene, k, size);
      starts.remember(window,
                      segmentMotions(window, scene.camera, starts.startOf(window), options));
    }
  }
  const Window window = test::windowFrom(scene, kWarmUp, size);
  const WarmStart start = starts.startOf(window);
  Segmentation found;
  for (auto _ : state) {
    found = segmentMotions(window, scene.camera, start, options);
    benchmark::DoNotOptimize(found);
  }
  state.counters["tracklets"] = static_cast<double>(window.tracklets.size());
  state.counters["motions"] = static_cast<double>(found.labeling.labels.size());
  state.counters["rounds"] = found.rounds;
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"tracklets", "frames", "motions", "threads"});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int tracklets : {250, 1000, 4000}) benchmark->Args({tracklets, 48, 5, 1});
  for (const int frames : {12, 96}) benchmark->Args({1000, frames, 5, 1});
  for (const int motions : {1, 10}) benchmark->Args({1000, 48, motions, 1});
  benchmark->Args({1000, 48, 5, 2});
}

BENCHMARK_CAPTURE(engine, cold, false)->Apply(cases);
BENCHMARK_CAPTURE(engine, warm, true)->Apply(cases);

}  // namespace
}  // namespace mvo
