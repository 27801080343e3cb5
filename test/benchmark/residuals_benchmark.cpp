// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The time of rho(p, l) for all tracklets under all labels.
#include <benchmark/benchmark.h>

#include "engine/residuals.hpp"
#include "support/benchmark_windows.hpp"

namespace mvo {
namespace {

void residuals(benchmark::State& state) {
  const test::SyntheticWindow scene = test::windowOf(state);
  const std::vector<Label> labels = test::trueLabels(scene).labels;
  for (auto _ : state)
    benchmark::DoNotOptimize(ResidualCache(scene.window, scene.camera, {}, {}).table(labels));
}
BENCHMARK(residuals)->Apply(test::windowSizes);

}  // namespace
}  // namespace mvo
