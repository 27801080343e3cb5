// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Synthetic windows for benchmarks, by their number of tracklets, motions and frames.
#pragma once

#include <benchmark/benchmark.h>

#include "mvo/types.hpp"
#include "support/synthetic_window.hpp"

namespace mvo::test {

/// A static world with half of the points and `motions` - 1 bodies that share the other half; one
/// point in twenty is an outlier. About `tracklets` in all, of 8 to 60 frames.
inline SyntheticWindow benchmarkWindow(int tracklets, int motions, int frames) {
  constexpr double kMeanLength = 34;
  const int slots = static_cast<int>(tracklets / (1 + frames / kMeanLength));
  SyntheticOptions o;
  o.frames = frames;
  o.outliers = slots / 20;
  const int bodies = motions - 1;
  o.static_points = bodies == 0 ? slots - o.outliers : slots / 2 - o.outliers;
  for (int i = 0; i < bodies; ++i) {
    SyntheticBody body;
    body.center = Eigen::Vector3d(0.9 * (i % 3 - 1), 0.8 * (i / 3 - 1), 4);
    body.radius = 0.35;
    body.points = slots / 2 / bodies;
    body.step << 0.01 * (i % 2 == 0 ? 1 : -1), 0.004 * (i % 3 - 1), 0.002, 0.01, 0.005 * i, 0.01;
    o.bodies.push_back(body);
  }
  return makeSyntheticWindow(o);
}

/// The truth as the labels of a last window.
inline Labeling trueLabels(const SyntheticWindow& scene) {
  Labeling labels;
  labels.assignment = scene.truth;
  for (int l = 0; l < static_cast<int>(scene.T_ck_c0.size()); ++l)
    labels.labels.push_back({l, scene.trajectory(l), l, 0});
  return labels;
}

/// One axis at a time through 1000 tracklets, five motions and 48 frames, the size that a video
/// gives.
inline void windowSizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgNames({"tracklets", "motions", "frames"})->Unit(benchmark::kMillisecond);
  for (const int tracklets : {250, 1000, 4000}) benchmark->Args({tracklets, 5, 48});
  for (const int motions : {1, 10}) benchmark->Args({1000, motions, 48});
  for (const int frames : {12, 96}) benchmark->Args({1000, 5, frames});
}

/// The window that a run's arguments describe; its size goes into the run's counters.
inline SyntheticWindow windowOf(benchmark::State& state) {
  SyntheticWindow scene =
      benchmarkWindow(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)),
                      static_cast<int>(state.range(2)));
  std::size_t observations = 0;
  for (const Tracklet& t : scene.window.tracklets) observations += t.observations.size();
  state.counters["tracklets"] = static_cast<double>(scene.window.tracklets.size());
  state.counters["observations"] = static_cast<double>(observations);
  return scene;
}

}  // namespace mvo::test
