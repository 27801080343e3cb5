// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// rho(p, l) by hand: which pairs count, what a missing transform costs, and the energy made of it.
#include "engine/residuals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kernels/link_residual.hpp"
#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

const StereoCamera kCamera{500, 500, 319.5, 239.5, 0.24, 640, 480};
constexpr double kSingle = 1e-4;  // residuals are taken in single precision [px]

// Eq. (1) over consecutive observations, as the paper has it.
EnergyOptions plain() {
  EnergyOptions options;
  options.residual = ResidualModel::kImageDistance;
  options.long_pairs = false;
  options.threshold = 1.5;
  return options;
}

// A point that a camera at rest sees at the given columns in frames first, first + 1, ...; NaN
// skips.
Tracklet columns(TrackletId id, FrameId first, const std::vector<double>& u) {
  Tracklet t{id, {}};
  for (std::size_t k = 0; k < u.size(); ++k)
    if (!std::isnan(u[k]))
      t.observations.push_back({first + static_cast<FrameId>(k), {u[k], 240, u[k] - 30}});
  return t;
}

// No motion at all in frames [first, first + frames).
Label still(FrameId first, int frames, int place = 0) {
  Label label;
  label.known = place;
  label.trajectory.first_frame = first;
  label.trajectory.T_ck_c1.assign(frames, Eigen::Isometry3d::Identity());
  label.trajectory.segment.assign(frames, 0);
  return label;
}

ResidualTable tableOf(const Window& window, const std::vector<Label>& labels,
                      const EnergyOptions& options) {
  return ResidualCache(window, kCamera, {}, options).table(labels);
}

TEST(Residuals, TheMaximumOverThePairsCounts) {
  const Window window{5, 8, {columns(0, 5, {100, 100.5, 103.25, 103})}};
  const ResidualTable table = tableOf(window, {still(5, 4)}, plain());
  EXPECT_NEAR(table.worst(0, 0), 2.75, kSingle);
  EXPECT_NEAR(table.overlap(0, 0), 2.75, kSingle);
}

TEST(Residuals, APairAcrossAGapCountsAsAPair) {
  const Window window{0, 3, {columns(0, 0, {100, NAN, NAN, 104})}};
  EXPECT_NEAR(tableOf(window, {still(0, 4)}, plain()).worst(0, 0), 4, kSingle);
}

TEST(Residuals, APairWithoutATransformCostsTheThreshold) {
  const Window window{
      0,
      3,
      {columns(0, 0, {100, 100.25, 100.25, 100.25}), columns(1, 0, {100, 102.5, 102.5, 102.5})}};
  const ResidualTable table = tableOf(window, {still(0, 2)}, plain());
  EXPECT_NEAR(table.overlap(0, 0), 0.25, kSingle);
  EXPECT_NEAR(table.worst(0, 0), 1.5, 1e-12);    // e_th
  EXPECT_NEAR(table.worst(1, 0), 2.5, kSingle);  // worse than e_th already
  // A break in the trajectory is a missing transform, too.
  Label broken = still(0, 4, 1);
  broken.trajectory.segment = {0, 0, 1, 1};
  EXPECT_NEAR(tableOf(window, {broken}, plain()).worst(0, 0), 1.5, 1e-12);
}

TEST(Residuals, NoSharedPairIsInadmissible) {
  const Window window{0, 9, {columns(0, 0, {100, 100, 100}), columns(1, 4, {100})}};
  const ResidualTable table = tableOf(window, {still(2, 8), still(0, 10, 1)}, plain());
  EXPECT_EQ(table.worst(0, 0), Energy::kInadmissible);  // shares frame 2 alone
  EXPECT_EQ(table.overlap(0, 0), Energy::kInadmissible);
  EXPECT_NEAR(table.worst(0, 1), 0, kSingle);
  EXPECT_EQ(table.worst(1, 1), Energy::kInadmissible);  // one observation has no pair
}

TEST(Residuals, LongPairsSeeSlowMotion) {
  std::vector<double> u;
  for (int k = 0; k < 24; ++k) u.push_back(100 + 0.25 * k);
  const Window window{0, 23, {columns(0, 0, u)}};
  EnergyOptions options = plain();
  EXPECT_NEAR(tableOf(window, {still(0, 24)}, options).worst(0, 0), 0.25, kSingle);
  options.long_pairs = true;
  EXPECT_NEAR(tableOf(window, {still(0, 24)}, options).worst(0, 0), 16 * 0.25, kSingle);
}

TEST(Residuals, LongPairsReachTheNewestObservation) {
  // At rest for 22 frames, then half a pixel aside in each of two.
  std::vector<double> u(24, 100);
  u[22] = 100.5;
  u[23] = 101;
  const Window window{0, 23, {columns(0, 0, u)}};
  EnergyOptions options = plain();
  options.long_pairs = true;
  EXPECT_NEAR(tableOf(window, {still(0, 24)}, options).worst(0, 0), 1, kSingle);
}

TEST(Residuals, TheTruthFitsAndOtherMotionsDoNot) {
  test::SyntheticOptions o;
  o.frames = 12;
  o.bodies = {{{-0.8, 0, 4}, 0.45, 30, (Vector6d() << 0.05, 0.02, 0, 0, 0, 0.01).finished()}};
  const test::SyntheticWindow scene = makeSyntheticWindow(o);
  std::vector<Label> labels;
  for (int l = 0; l < 2; ++l) labels.push_back({l, scene.trajectory(l), l});
  ResidualCache cache(scene.window, scene.camera, {}, {});
  const ResidualTable table = cache.table(labels);
  for (std::size_t p = 0; p < scene.truth.size(); ++p) {
    const int l = scene.truth[p];
    if (l == kOutlier || scene.window.tracklets[p].observations.size() < 5) continue;
    EXPECT_LT(table.worst(p, l), 0.8);
    EXPECT_GT(table.worst(p, 1 - l), 1.5);
    EXPECT_EQ(cache.overlap(labels[l])(p), table.overlap(p, l));
  }
}

// The definition, pair by pair and in double precision.
double worstPairByPair(const Tracklet& tracklet, const Trajectory& trajectory,
                       const LinkResidual& residual) {
  double worst = -1;
  const auto& o = tracklet.observations;
  const auto take = [&](const Observation& a, const Observation& b) {
    if (const auto T = trajectory.between(b.frame, a.frame))
      worst = std::max(worst, residual(*T, a.y, b.y));
  };
  for (std::size_t j = 1; j < o.size(); ++j) take(o[j - 1], o[j]);
  for (const int d : {2, 4, 8, 16})
    for (int j = static_cast<int>(o.size()) - 1; j > 1; j -= std::max(1, d / 2))
      if (const Observation* a = tracklet.find(o[j].frame - d)) take(*a, o[j]);
  return worst;
}

TEST(Residuals, AgreePairByPairWithTheResidualOfOneLink) {
  test::SyntheticOptions o;
  o.frames = 30;
  o.gaps = 0.1;
  o.bodies = {{{-0.8, 0, 4}, 0.45, 30, (Vector6d() << 0.05, 0.02, 0, 0, 0, 0.01).finished()}};
  const test::SyntheticWindow scene = makeSyntheticWindow(o);
  Label label{0, scene.trajectory(0), 0};
  for (std::size_t k = 12; k < label.trajectory.segment.size(); ++k)
    label.trajectory.segment[k] = 1;  // torn in two
  for (const ResidualModel model : {ResidualModel::kWhitened, ResidualModel::kImageDistance}) {
    EnergyOptions options;
    options.residual = model;
    const LinkResidual residual(scene.camera, {}, model);
    ResidualCache cache(scene.window, scene.camera, {}, options);
    const Eigen::VectorXd& overlap = cache.overlap(label);
    for (std::size_t p = 0; p < scene.truth.size(); ++p) {
      const double expected =
          worstPairByPair(scene.window.tracklets[p], label.trajectory, residual);
      if (expected < 0)
        EXPECT_EQ(overlap(p), Energy::kInadmissible);
      else
        EXPECT_NEAR(overlap(p), expected, 1e-3 + 1e-4 * expected);
    }
  }
}

TEST(ResidualCache, RemembersALabelByItsKey) {
  const Window window{0, 3, {columns(0, 0, {100, 101, 101, 101})}};
  ResidualCache cache(window, kCamera, {}, plain());
  EXPECT_NEAR(cache.table({still(0, 4, 7)}).worst(0, 0), 1, kSingle);
  const ResidualTable both = cache.table({still(2, 2, 8), still(0, 4, 7)});
  EXPECT_NEAR(both.worst(0, 0), 1.5, kSingle);
  EXPECT_NEAR(both.worst(0, 1), 1, kSingle);
}

TEST(DataCost, IsZeroInTheDeadZoneAndLinearBeyond) {
  EnergyOptions options;
  options.dead_zone = 0.6;
  EXPECT_EQ(dataCost(0.6, options), 0);
  EXPECT_DOUBLE_EQ(dataCost(1.0, options), 0.4);
  EXPECT_EQ(dataCost(Energy::kInadmissible, options), Energy::kInadmissible);
}

TEST(MakeEnergy, OutlierCostByHand) {
  EnergyOptions options;
  options.dead_zone = 0;
  options.outlier_scale = 100;  // alpha
  options.outlier_decay = 2;    // beta
  options.smoothness = 0.5;
  options.label_cost = 30;
  ResidualTable table;
  table.worst.resize(3, 2);
  table.worst << 4, 3, 0, 1, Energy::kInadmissible, Energy::kInadmissible;
  table.overlap = table.worst;
  Graph graph;
  graph.edges = {{0, 1}, {1, 2}};
  const Energy energy = makeEnergy(table, graph, options);
  ASSERT_EQ(energy.outlier(), 2);
  EXPECT_NEAR(energy.data(0, 2), 22.3130160148, 1e-9);  // 100 exp(-3 / 2)
  EXPECT_NEAR(energy.data(1, 2), 100, 1e-12);
  EXPECT_NEAR(energy.data(2, 2), 0, 1e-12);  // no label can hold it
  EXPECT_EQ(energy.data.leftCols(2), table.worst);
  EXPECT_EQ(energy.label_cost, Eigen::Vector3d(30, 30, 0));
  ASSERT_EQ(energy.edges.size(), 2U);
  EXPECT_EQ(energy.edges[1].q, 2);
  EXPECT_EQ(energy.edges[1].weight, 0.5);
}

TEST(MakeEnergy, TheOutlierCostIsTakenBeyondTheDeadZone) {
  EnergyOptions options;
  options.dead_zone = 0.5;
  options.outlier_scale = 10;
  options.outlier_decay = 1;
  ResidualTable table;
  table.worst = Eigen::MatrixXd::Constant(1, 1, 1.5);
  table.overlap = table.worst;
  EXPECT_NEAR(makeEnergy(table, {}, options).data(0, 1), 3.67879441171, 1e-9);  // 10 / e
}

TEST(MakeEnergy, WithoutLabelsOutliersAreFree) {
  ResidualTable table;
  table.worst.resize(2, 0);
  table.overlap.resize(2, 0);
  const Energy energy = makeEnergy(table, {}, {});
  EXPECT_EQ(energy.outlier(), 0);
  EXPECT_NEAR(energy.evaluate({0, 0}), 0, 1e-12);
}

}  // namespace
}  // namespace mvo
