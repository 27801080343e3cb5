// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-A's time.
#include <benchmark/benchmark.h>

#include "engine/graph/graph.hpp"
#include "support/benchmark_windows.hpp"

namespace mvo {
namespace {

void graph(benchmark::State& state) {
  const test::SyntheticWindow scene = test::windowOf(state);
  for (auto _ : state) benchmark::DoNotOptimize(buildGraph(scene.window, {}));
}
BENCHMARK(graph)->Apply(test::windowSizes);

}  // namespace
}  // namespace mvo
