// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-B: what components propose, and labels that go on to the next frame.
#include "engine/proposal.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "engine/graph/graph.hpp"
#include "support/synthetic_window.hpp"

namespace mvo {
namespace {

constexpr int kMinObservations = 5;  // of a label in a frame

LinkResidual whitened(const StereoCamera& camera) { return {camera, {}, ResidualModel::kWhitened}; }

Label knownLabel(const test::SyntheticWindow& scene, int l) {
  Label label;
  label.id = l;
  label.trajectory = scene.trajectory(l);
  label.known = l;
  return label;
}

Vector6d step(double x, double y, double z, double turn) {
  return (Vector6d() << x, y, z, 0, turn, 0).finished();
}

// A static world and a body that nobody can take for it.
test::SyntheticOptions oneBody() {
  test::SyntheticOptions o;
  o.frames = 10;
  o.static_points = 60;
  o.outliers = 0;
  o.bodies = {{{-0.7, 0.2, 4}, 0.5, 30, step(0.05, 0.03, 0, 0.02)}};
  return o;
}

std::vector<int> everyone(const Window& window) {
  std::vector<int> all(window.tracklets.size());
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// The largest error of a trajectory's steps.
double stepError(const Trajectory& trajectory, const test::SyntheticWindow& scene, int label) {
  double worst = 0;
  for (FrameId k = trajectory.first_frame + 1; k <= trajectory.lastFrame(); ++k) {
    const auto T = trajectory.between(k, k - 1);
    if (!T) return std::numeric_limits<double>::infinity();
    worst = std::max(worst, log(*T * scene.between(label, k, k - 1).inverse()).norm());
  }
  return worst;
}

TEST(ProposeTrajectory, FindsTheDominantMotionAndSplitsByTheMajorityOfPairs) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  const Proposal proposal =
      proposeTrajectory(scene.window, everyone(scene.window), whitened(scene.camera), {}, 1);
  EXPECT_EQ(proposal.trajectory.first_frame, 0);
  EXPECT_EQ(proposal.trajectory.lastFrame(), 9);
  EXPECT_LT(stepError(proposal.trajectory, scene, 0), 0.02);
  EXPECT_EQ(proposal.inliers.size() + proposal.outliers.size(), scene.truth.size());
  int wrong = 0;
  for (const int p : proposal.inliers)
    wrong += scene.truth[p] != 0 && scene.window.tracklets[p].observations.size() > 1 ? 1 : 0;
  for (const int p : proposal.outliers) wrong += scene.truth[p] == 0 ? 1 : 0;
  EXPECT_LE(wrong, 2);
}

TEST(ProposeTrajectory, ATrackletNeedsMoreThanHalfOfItsPairs) {
  test::SyntheticOptions o = oneBody();
  o.bodies.clear();
  o.noise = o.disparity = o.gaps = 0;
  o.min_length = o.frames;
  test::SyntheticWindow scene = makeSyntheticWindow(o);
  // Displaces the last frames of two tracklets more and more: `bad` of their nine pairs.
  const auto spoil = [&](int p, int bad) {
    auto& observations = scene.window.tracklets[p].observations;
    for (int i = 0; i < bad; ++i) {
      auto& y = observations[observations.size() - bad + i].y;
      y += Eigen::Vector3d(0, 6.0 * (i + 1), 0);
    }
  };
  std::vector<int> whole;
  for (std::size_t p = 0; p < scene.truth.size(); ++p)
    if (scene.window.tracklets[p].observations.size() == 10) whole.push_back(static_cast<int>(p));
  ASSERT_GE(whole.size(), 10U);
  spoil(whole[3], 4);
  spoil(whole[7], 5);
  const Proposal proposal = proposeTrajectory(scene.window, whole, whitened(scene.camera), {}, 1);
  EXPECT_EQ(proposal.outliers, std::vector<int>{whole[7]});
}

TEST(ProposeTrajectory, FramesWithTooFewPairsBreakTheTrajectory) {
  test::SyntheticOptions o = oneBody();
  o.static_points = 20;
  o.bodies.clear();
  const test::SyntheticWindow whole = makeSyntheticWindow(o);
  Window window = slice(whole, 0, 4).window;
  for (Tracklet t : slice(whole, 5, 9).window.tracklets) {
    t.id += 1000;  // nobody bridges frames 4 and 5
    window.tracklets.push_back(t);
  }
  window.last_frame = 9;
  const Trajectory trajectory =
      proposeTrajectory(window, everyone(window), whitened(whole.camera), {}, 1).trajectory;
  EXPECT_TRUE(trajectory.between(4, 0));
  EXPECT_TRUE(trajectory.between(9, 5));
  EXPECT_FALSE(trajectory.between(5, 4));
}

TEST(ProposeTrajectory, IsDeterministic) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  const auto once =
      proposeTrajectory(scene.window, everyone(scene.window), whitened(scene.camera), {}, 5);
  const auto twice =
      proposeTrajectory(scene.window, everyone(scene.window), whitened(scene.camera), {}, 5);
  EXPECT_EQ(once.inliers, twice.inliers);
  EXPECT_EQ(once.trajectory.T_ck_c1.back().matrix(), twice.trajectory.T_ck_c1.back().matrix());
}

// One round of proposals from a labelling.
Labeling propose(const test::SyntheticWindow& scene, Labeling labels, bool warm,
                 const Graph& graph) {
  const Options options;
  ResidualCache residuals(scene.window, scene.camera, options.noise, options.energy);
  const LinkResidual residual = whitened(scene.camera);
  return Proposer(scene.window, graph, residual, options.proposal, options.energy.threshold,
                  options.seed, warm)
      .propose(std::move(labels), residuals);
}

TEST(Proposer, OutliersAreProposedFromAtLast) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  const Labeling labels = propose(scene, {{}, std::vector<int>(scene.truth.size(), kOutlier)},
                                  false, buildGraph(scene.window, {5}));
  ASSERT_EQ(labels.labels.size(), 1U);
  EXPECT_LT(stepError(labels.labels[0].trajectory, scene, 0), 0.02);
  EXPECT_GT(labels.support(kOutlier).size(), 20U);  // the body, until the next round
}

TEST(Proposer, DisjointComponentsProposeSeparately) {
  test::SyntheticOptions o = oneBody();
  o.static_points = 0;
  o.bodies = {{{-1, 0, 4}, 0.4, 25, step(0.03, 0, 0, 0)},
              {{1, 0, 4}, 0.4, 25, step(0, 0.03, 0, 0)}};
  const test::SyntheticWindow scene = makeSyntheticWindow(o);
  const Labeling labels = propose(scene, {{}, std::vector<int>(scene.truth.size(), kOutlier)},
                                  false, buildGraph(scene.window, {5}));
  ASSERT_EQ(labels.labels.size(), 2U);
  EXPECT_GT(test::agreement(scene, labels.assignment).share, 0.97);
  EXPECT_NE(labels.labels[0].key(), labels.labels[1].key());
}

TEST(Proposer, ComponentsThatAreTooSmallProposeNothing) {
  test::SyntheticOptions o = oneBody();
  o.static_points = 5;
  o.min_length = o.frames;
  o.bodies.clear();
  test::SyntheticWindow scene = slice(makeSyntheticWindow(o), 0, 3);
  ASSERT_LT(scene.truth.size(), 6U);
  const Labeling labels = propose(scene, {{}, std::vector<int>(scene.truth.size(), kOutlier)},
                                  false, buildGraph(scene.window, {5}));
  EXPECT_TRUE(labels.labels.empty());
}

TEST(Proposer, WarmKeepsALabelThatExplainsItsSupportAndColdProposesAnew) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  Labeling labels;
  labels.assignment = scene.truth;
  for (int l = 0; l < 2; ++l) labels.labels.push_back(knownLabel(scene, l));
  const Graph graph = buildGraph(scene.window, {5});
  EXPECT_EQ(propose(scene, labels, true, graph).labels.size(), 2U);
  EXPECT_GT(propose(scene, labels, false, graph).labels.size(), 2U);
  // A label that is wrong about its support is challenged in any case.
  std::swap(labels.labels[0].trajectory, labels.labels[1].trajectory);
  EXPECT_GT(propose(scene, labels, true, graph).labels.size(), 2U);
}

TEST(ExtendLabels, CarriesEachLabelOnByItsOwnTracklets) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  Labeling labels;
  labels.assignment = scene.truth;
  for (int l = 0; l < 2; ++l) labels.labels.push_back(knownLabel(scene, l));
  for (Label& label : labels.labels) {
    label.trajectory.T_ck_c1.resize(8);
    label.trajectory.segment.resize(8);
  }
  const Labeling extended =
      extendLabels(scene.window, whitened(scene.camera), labels, {}, kMinObservations, 1);
  for (int l = 0; l < 2; ++l) {
    ASSERT_EQ(extended.labels[l].trajectory.lastFrame(), 9);
    EXPECT_LT(stepError(extended.labels[l].trajectory, scene, l), 0.02) << "label " << l;
  }
  EXPECT_EQ(extended.assignment, labels.assignment);
}

TEST(ExtendLabels, ALabelWithoutTrackletsHasNoMotion) {
  const test::SyntheticWindow scene = makeSyntheticWindow(oneBody());
  Labeling labels{{knownLabel(scene, 0)}, std::vector<int>(scene.truth.size(), kOutlier)};
  labels.labels[0].trajectory.T_ck_c1.resize(9);
  labels.labels[0].trajectory.segment.resize(9);
  const Trajectory extended =
      extendLabels(scene.window, whitened(scene.camera), labels, {}, kMinObservations, 1)
          .labels[0]
          .trajectory;
  EXPECT_EQ(extended.lastFrame(), 9);
  EXPECT_FALSE(extended.between(9, 8));
  EXPECT_TRUE(extended.between(8, 0));
}

}  // namespace
}  // namespace mvo
