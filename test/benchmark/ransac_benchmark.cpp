// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The time of one frame pair's motion, by the number of pairs and the share of outliers [%].
#include <benchmark/benchmark.h>

#include <random>

#include "engine/ransac.hpp"
#include "support/benchmark_windows.hpp"

namespace mvo {
namespace {

// The newest frame pair of a static world.
std::vector<StereoPair> makePairs(const StereoCamera& camera, int n, int outliers) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::normal_distribution<double> noise(0, 0.1);
  const Eigen::Isometry3d T_b_a(Eigen::Translation3d(0.02, 0, -0.1));
  std::vector<StereoPair> pairs;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p(4 * uniform(random) - 2, 3 * uniform(random) - 1.5,
                            3 + 6 * uniform(random));
    StereoPair pair{camera.project(p), camera.project(T_b_a * p)};
    for (int c = 0; c < 3; ++c) {
      pair.y_a(c) += noise(random);
      pair.y_b(c) += noise(random);
    }
    if (100 * i < outliers * n) pair.y_b += Eigen::Vector3d(20 * uniform(random) + 5, 7, 9);
    pairs.push_back(pair);
  }
  return pairs;
}

void ransac(benchmark::State& state, const ProposalOptions& options) {
  const StereoCamera camera = test::SyntheticOptions().camera;
  const auto pairs =
      makePairs(camera, static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  const LinkResidual residual(camera, {}, ResidualModel::kWhitened);
  std::uint64_t seed = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ransacMotion(pairs, residual, options, ++seed));
}
BENCHMARK_CAPTURE(ransac, defaults, ProposalOptions())
    ->ArgNames({"pairs", "outliers"})
    ->ArgsProduct({{10, 75, 300, 1200}, {0, 50}})
    ->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(ransac, paper, paperOptions().proposal)
    ->ArgNames({"pairs", "outliers"})
    ->ArgsProduct({{75, 300}, {0, 50}})
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mvo
