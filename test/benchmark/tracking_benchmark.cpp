// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The front end's time on simulated images with as many points as it follows by default: what
// depends on the images alone, following the points, and new corners in an image without any.
#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "frontend/detection.hpp"
#include "support/rendered_sequence.hpp"
#include "support/tracked_window.hpp"

namespace mvo {
namespace {

constexpr int kFrames = 8;

const test::RenderedSequence& blocks(int width, int height) {
  static std::map<std::pair<int, int>, test::RenderedSequence> rendered;
  const auto [it, fresh] = rendered.try_emplace({width, height});
  if (fresh) it->second = test::renderBlocks(width, height, kFrames);
  return it->second;
}

const test::RenderedSequence& blocksOf(const benchmark::State& state) {
  cv::setNumThreads(static_cast<int>(state.range(2)));
  return blocks(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
}

void prepare(benchmark::State& state) {
  const test::RenderedSequence& sequence = blocksOf(state);
  const FrontendOptions options;
  for (auto _ : state)
    benchmark::DoNotOptimize(prepareFrame(sequence.frames.front(), sequence.camera, options));
}

void track(benchmark::State& state) {
  const test::RenderedSequence& sequence = blocksOf(state);
  const Options options;
  test::TrackedWindow before(sequence.camera, options);
  for (int k = 0; k < kFrames - 1; ++k) before.add(sequence.frames[static_cast<std::size_t>(k)]);
  const TrackingPrior prior = before.prior();
  const FrameImages images =
      *prepareFrame(sequence.frames.back(), sequence.camera, options.frontend).images;
  std::size_t features = 0;
  for (auto _ : state) {
    state.PauseTiming();
    FeatureTracker tracker = before.tracker();
    state.ResumeTiming();
    features = tracker.track(images, prior, sequence.camera, options.frontend).size();
  }
  state.counters["features"] = static_cast<double>(features);
}

void detect(benchmark::State& state) {
  const cv::Mat& image = blocksOf(state).frames.front().left;
  const FrontendOptions options;
  std::size_t corners = 0;
  for (auto _ : state)
    corners = detectCorners(findCornerPeaks(image), image.size(), {}, {}, options).size();
  state.counters["corners"] = static_cast<double>(corners);
}

void cases(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"width", "height", "threads"});
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
  for (const int threads : {1, 2})
    for (const auto& [width, height] : {std::pair{640, 480}, {1241, 376}, {1280, 960}})
      benchmark->Args({width, height, threads});
}

BENCHMARK(prepare)->Apply(cases);
BENCHMARK(track)->Apply(cases);
BENCHMARK(detect)->Apply(cases);

}  // namespace
}  // namespace mvo
