// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-D: which labels merge, in which order, and that Eq. (2) never rises.
#include "engine/merging.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace mvo {
namespace {

EnergyOptions options(double label_cost, double smoothness = 0) {
  EnergyOptions o;
  o.dead_zone = 0;
  o.label_cost = label_cost;
  o.smoothness = smoothness;
  return o;
}

// Tracklets of frames [0, 10), so that time is no hindrance.
Window windowOf(int tracklets) {
  Window window{0, 9, {}};
  for (int p = 0; p < tracklets; ++p) {
    Tracklet t{p, {}};
    for (int k = 0; k < 10; ++k) t.observations.push_back({k, {100.0 + p, 100, 90.0 + p}});
    window.tracklets.push_back(t);
  }
  return window;
}

ResidualTable tableOf(const Eigen::MatrixXd& residuals) { return {residuals, residuals}; }

Labeling labelingOf(int labels, const std::vector<int>& assignment) {
  Labeling labeling{std::vector<Label>(labels), assignment};
  for (int l = 0; l < labels; ++l) labeling.labels[l].known = l;
  return labeling;
}

// A chain over all tracklets.
Graph chain(int tracklets) {
  Graph graph;
  graph.neighbors.resize(tracklets);
  for (int p = 0; p + 1 < tracklets; ++p) {
    graph.edges.emplace_back(p, p + 1);
    graph.neighbors[p].push_back(p + 1);
    graph.neighbors[p + 1].push_back(p);
  }
  return graph;
}

double energyOf(const ResidualTable& table, const Graph& graph, const EnergyOptions& o,
                std::vector<int> assignment) {
  const Energy energy = makeEnergy(table, graph, o);
  for (int& l : assignment)
    if (l == kOutlier) l = energy.outlier();
  return energy.evaluate(assignment);
}

TEST(Merging, RedundantLabelsBecomeOne) {
  const Eigen::MatrixXd residuals =
      (Eigen::MatrixXd(4, 2) << 0.1, 0.3, 0.1, 0.3, 0.2, 0.1, 0.2, 0.1).finished();
  const Labeling merged =
      mergeLabels(windowOf(4), chain(4), tableOf(residuals), labelingOf(2, {0, 0, 1, 1}),
                  options(5), MergeScope::kAdjacent);
  // 1 -> 0 costs 0.2, 0 -> 1 costs 0.4.
  EXPECT_EQ(merged.assignment, (std::vector<int>{0, 0, 0, 0}));
  EXPECT_EQ(dropEmptyLabels(merged).labels.size(), 1U);
}

TEST(Merging, TheLabelCostAndTheSmoothnessAreTheLimit) {
  // Merging either way adds 3 to the residuals.
  const Eigen::MatrixXd residuals = (Eigen::MatrixXd(2, 2) << 0, 3, 3, 0).finished();
  const auto merges = [&](double label_cost, double smoothness) {
    return mergeLabels(windowOf(2), chain(2), tableOf(residuals), labelingOf(2, {0, 1}),
                       options(label_cost, smoothness), MergeScope::kAdjacent)
               .assignment != std::vector<int>{0, 1};
  };
  EXPECT_FALSE(merges(2.9, 0));
  EXPECT_TRUE(merges(3.1, 0));
  EXPECT_FALSE(merges(2, 0.9));
  EXPECT_TRUE(merges(2, 1.1));
}

TEST(Merging, BestGainFirst) {
  // The middle label could join either neighbour, not both: left costs 2, right costs 1.
  const Eigen::MatrixXd residuals = (Eigen::MatrixXd(3, 3) << 0, 9, 9, 2, 0, 1, 9, 9, 0).finished();
  EXPECT_EQ(mergeLabels(windowOf(3), chain(3), tableOf(residuals), labelingOf(3, {0, 1, 2}),
                        options(4), MergeScope::kAdjacent)
                .assignment,
            (std::vector<int>{0, 2, 2}));
}

TEST(Merging, GoesOnUntilNothingIsGained) {
  constexpr int kCount = 6;
  const std::vector<int> merged =
      mergeLabels(windowOf(kCount), chain(kCount), tableOf(Eigen::MatrixXd::Zero(kCount, kCount)),
                  labelingOf(kCount, {0, 1, 2, 3, 4, 5}), options(1), MergeScope::kAdjacent)
          .assignment;
  EXPECT_EQ(merged, std::vector<int>(kCount, merged[0]));
}

TEST(Merging, OnlyAdjacentLabelsUnlessToldOtherwise) {
  const ResidualTable table = tableOf(Eigen::MatrixXd::Zero(4, 2));
  Graph graph = chain(4);
  graph.edges.erase(graph.edges.begin() + 1);  // 0 - 1 and 2 - 3
  const Labeling labels = labelingOf(2, {0, 0, 1, 1});
  EXPECT_EQ(
      mergeLabels(windowOf(4), graph, table, labels, options(5), MergeScope::kAdjacent).assignment,
      labels.assignment);
  const auto any =
      mergeLabels(windowOf(4), graph, table, labels, options(5), MergeScope::kAny).assignment;
  EXPECT_EQ(any, std::vector<int>(4, any[0]));
}

TEST(Merging, AnOutlierBetweenTwoLabelsDoesNotJoinThem) {
  const Labeling labels = labelingOf(2, {0, kOutlier, 1});
  EXPECT_EQ(mergeLabels(windowOf(3), chain(3), tableOf(Eigen::MatrixXd::Zero(3, 2)), labels,
                        options(5), MergeScope::kAdjacent)
                .assignment,
            labels.assignment);
}

TEST(Merging, OutliersStayOutliers) {
  const Labeling labels = labelingOf(1, {0, kOutlier, 0});
  EXPECT_EQ(mergeLabels(windowOf(3), chain(3), tableOf(Eigen::MatrixXd::Zero(3, 1)), labels,
                        options(1e4), MergeScope::kAny)
                .assignment,
            labels.assignment);
}

TEST(Merging, LabelsThatShareNoFramePairNeverMerge) {
  Window window = windowOf(4);
  for (int p = 0; p < 4; ++p) {
    auto& o = window.tracklets[p].observations;
    if (p < 2)
      o.resize(5);  // frames 0 .. 4
    else
      o.erase(o.begin(), o.begin() + 5);  // frames 5 .. 9
  }
  const ResidualTable table = tableOf(Eigen::MatrixXd::Zero(4, 2));
  const Labeling labels = labelingOf(2, {0, 0, 1, 1});
  EXPECT_EQ(mergeLabels(window, chain(4), table, labels, options(100), MergeScope::kAny).assignment,
            labels.assignment);
  // One shared frame is no shared pair, two are.
  auto& early = window.tracklets[1].observations;
  early.push_back({5, early.back().y});
  EXPECT_EQ(mergeLabels(window, chain(4), table, labels, options(100), MergeScope::kAny).assignment,
            labels.assignment);
  early.push_back({6, early.back().y});
  EXPECT_NE(mergeLabels(window, chain(4), table, labels, options(100), MergeScope::kAny).assignment,
            labels.assignment);
}

TEST(Merging, OnlySharedTimeCounts) {
  // Label 1 fits the tracklet of 0 while it exists; the rest of its time costs nothing here.
  ResidualTable table = tableOf((Eigen::MatrixXd(2, 2) << 0, 0.1, 50, 0).finished());
  table.worst(0, 1) = 1e3;
  EXPECT_EQ(mergeLabels(windowOf(2), chain(2), table, labelingOf(2, {0, 1}), options(1),
                        MergeScope::kAdjacent)
                .assignment,
            (std::vector<int>{1, 1}));
}

TEST(Merging, NeverRaisesTheEnergy) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  int merges = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const int n = 12;
    const int labels = 4;
    Eigen::MatrixXd residuals(n, labels);
    std::vector<int> assignment(n);
    for (int p = 0; p < n; ++p) {
      assignment[p] = static_cast<int>(random() % (labels + 1)) - 1;
      for (int l = 0; l < labels; ++l) residuals(p, l) = 3 * uniform(random);
    }
    const EnergyOptions o = options(8 * uniform(random), uniform(random));
    const ResidualTable table = tableOf(residuals);
    const Graph graph = chain(n);
    for (const MergeScope scope : {MergeScope::kAdjacent, MergeScope::kAny}) {
      const Labeling merged =
          mergeLabels(windowOf(n), graph, table, labelingOf(labels, assignment), o, scope);
      const double before = energyOf(table, graph, o, assignment);
      const double after = energyOf(table, graph, o, merged.assignment);
      EXPECT_LE(after, before + 1e-9);
      if (merged.assignment != assignment) {
        EXPECT_LT(after, before);
        ++merges;
      }
    }
  }
  EXPECT_GT(merges, 100);
}

TEST(Merging, NoMergeIsLeftThatWouldPay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const int n = 10;
  const int labels = 4;
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::MatrixXd residuals(n, labels);
    std::vector<int> assignment(n);
    for (int p = 0; p < n; ++p) {
      assignment[p] = static_cast<int>(random() % labels);
      for (int l = 0; l < labels; ++l) residuals(p, l) = 3 * uniform(random);
    }
    const EnergyOptions o = options(3, 0.2);
    const ResidualTable table = tableOf(residuals);
    const std::vector<int> merged = mergeLabels(windowOf(n), chain(n), table,
                                                labelingOf(labels, assignment), o, MergeScope::kAny)
                                        .assignment;
    const double energy = energyOf(table, chain(n), o, merged);
    for (int from = 0; from < labels; ++from)
      for (int to = 0; to < labels; ++to) {
        if (std::count(merged.begin(), merged.end(), to) == 0) continue;
        std::vector<int> other = merged;
        std::replace(other.begin(), other.end(), from, to);
        EXPECT_GE(energyOf(table, chain(n), o, other), energy - 1e-9);
      }
  }
}

TEST(Merging, WithoutLabels) {
  const Labeling none = labelingOf(0, {kOutlier, kOutlier});
  EXPECT_EQ(mergeLabels(windowOf(2), chain(2), tableOf(Eigen::MatrixXd(2, 0)), none, options(1),
                        MergeScope::kAny)
                .assignment,
            none.assignment);
  EXPECT_TRUE(dropEmptyLabels(none).labels.empty());
}

TEST(DropEmptyLabels, RenumbersWhatIsLeft) {
  const Labeling kept = dropEmptyLabels(labelingOf(4, {3, kOutlier, 1, 3}));
  ASSERT_EQ(kept.labels.size(), 2U);
  EXPECT_EQ(kept.labels[0].known, 1);
  EXPECT_EQ(kept.labels[1].known, 3);
  EXPECT_EQ(kept.assignment, (std::vector<int>{1, kOutlier, 0, 1}));
}

}  // namespace
}  // namespace mvo
