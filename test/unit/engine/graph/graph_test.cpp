// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-A: the neighbourhood graph against its definition.
#include "engine/graph/graph.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace mvo {
namespace {

using Edges = std::vector<std::pair<int, int>>;

// Tracklets that walk, with gaps, births and ends anywhere in a window that starts at frame 7.
Window randomWindow(int tracklets, int frames, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Window window{7, 7 + frames - 1, {}};
  for (int i = 0; i < tracklets; ++i) {
    Tracklet t{100 + i, {}};
    const int first = static_cast<int>(uniform(random) * frames);
    const int last = first + static_cast<int>(uniform(random) * (frames - first));
    Eigen::Vector3d y(640 * uniform(random), 480 * uniform(random), 10);
    for (int k = first; k <= last; ++k) {
      y += Eigen::Vector3d(20 * (uniform(random) - 0.5), 20 * (uniform(random) - 0.5), 0);
      if (k == first || k == last || uniform(random) > 0.25) t.observations.push_back({7 + k, y});
    }
    window.tracklets.push_back(t);
  }
  return window;
}

// The definition: the maximum image distance over common frames; negative if there is none.
double maxDistance(const Tracklet& p, const Tracklet& q) {
  double largest = -1;
  for (const Observation& o : p.observations)
    if (const Observation* other = q.find(o.frame))
      largest = std::max(largest, (o.y - other->y).head<2>().norm());
  return largest;
}

Edges bruteForce(const Window& window, int k) {
  std::set<std::pair<int, int>> edges;
  const int n = static_cast<int>(window.tracklets.size());
  for (int i = 0; i < n; ++i) {
    std::vector<std::pair<double, int>> others;
    for (int j = 0; j < n; ++j) {
      const double d = i == j ? -1 : maxDistance(window.tracklets[i], window.tracklets[j]);
      if (d >= 0) others.emplace_back(d, j);
    }
    std::sort(others.begin(), others.end());
    if (static_cast<int>(others.size()) > k) others.resize(k);
    for (const auto& [d, j] : others) edges.insert(std::minmax(i, j));
  }
  return {edges.begin(), edges.end()};
}

Tracklet at(TrackletId id, FrameId first, int frames, double u, double v) {
  Tracklet t{id, {}};
  for (int k = 0; k < frames; ++k) t.observations.push_back({first + k, {u, v, u - 10}});
  return t;
}

TEST(Graph, IsTheExactNeighborhoodOnRandomWindowsWithGaps) {
  for (unsigned seed = 1; seed <= 6; ++seed)
    for (const int k : {1, 3, 5}) {
      const Window window = randomWindow(20 + 30 * static_cast<int>(seed), 14, seed);
      EXPECT_EQ(buildGraph(window, {k}).edges, bruteForce(window, k)) << seed << ", k = " << k;
    }
}

TEST(Graph, IsUndirectedWithEveryPairOnce) {
  const Graph graph = buildGraph(randomWindow(150, 12, 3), {5});
  ASSERT_FALSE(graph.edges.empty());
  for (const auto& [a, b] : graph.edges) EXPECT_LT(a, b);
  EXPECT_TRUE(std::is_sorted(graph.edges.begin(), graph.edges.end()));
  EXPECT_EQ(std::adjacent_find(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  Edges from_neighbors;
  for (int p = 0; p < static_cast<int>(graph.neighbors.size()); ++p) {
    EXPECT_TRUE(std::is_sorted(graph.neighbors[p].begin(), graph.neighbors[p].end()));
    for (const int q : graph.neighbors[p]) {
      EXPECT_TRUE(std::binary_search(graph.neighbors[q].begin(), graph.neighbors[q].end(), p));
      if (p < q) from_neighbors.emplace_back(p, q);
    }
  }
  EXPECT_EQ(from_neighbors, graph.edges);
}

TEST(Graph, TheMaximumOverCommonFramesDecides) {
  // Tracklet 1 is beside 0 at first and far at last; 2 is always 30 px away.
  Window window{0, 1, {at(0, 0, 2, 100, 100), at(1, 0, 2, 105, 100), at(2, 0, 2, 130, 100)}};
  window.tracklets[1].observations[1].y << 130, 400, 120;
  EXPECT_EQ(buildGraph(window, {1}).edges, (Edges{{0, 2}, {1, 2}}));
}

TEST(Graph, TrackletsThatNeverCoexistAreNotConnected) {
  const Window window{0, 9, {at(0, 0, 5, 100, 100), at(1, 5, 5, 100, 100), at(2, 4, 2, 600, 400)}};
  EXPECT_EQ(buildGraph(window, {5}).edges, (Edges{{0, 2}, {1, 2}}));
  // Seen in turns: the spans overlap, no frame is common.
  Window turns{0, 3, {{0, {}}, {1, {}}}};
  for (int k = 0; k < 4; ++k)
    turns.tracklets[k % 2].observations.push_back({k, {100.0 + k, 100, 90}});
  EXPECT_TRUE(buildGraph(turns, {5}).edges.empty());
}

TEST(Graph, TiesGoToTheLowerIndex) {
  const Window window{0, 0, {at(0, 0, 1, 100, 110), at(1, 0, 1, 100, 100), at(2, 0, 1, 100, 90)}};
  EXPECT_EQ(buildGraph(window, {1}).edges, (Edges{{0, 1}, {1, 2}}));
  const Window square{
      0, 0, {at(0, 0, 1, 0, 0), at(1, 0, 1, 10, 0), at(2, 0, 1, 10, 10), at(3, 0, 1, 0, 10)}};
  EXPECT_EQ(buildGraph(square, {1}).edges, (Edges{{0, 1}, {0, 3}, {1, 2}}));
}

TEST(Graph, IsDeterministic) {
  const Window window = randomWindow(300, 20, 9);
  EXPECT_EQ(buildGraph(window, {5}).edges, buildGraph(window, {5}).edges);
}

TEST(Graph, FewTracklets) {
  EXPECT_TRUE(buildGraph({}, {5}).edges.empty());
  EXPECT_TRUE(buildGraph({0, 4, {}}, {5}).neighbors.empty());
  const Graph one = buildGraph({0, 4, {at(0, 1, 3, 10, 10)}}, {5});
  EXPECT_TRUE(one.edges.empty());
  EXPECT_EQ(one.neighbors.size(), 1U);
  EXPECT_EQ(buildGraph({0, 4, {at(0, 1, 3, 10, 10), at(1, 3, 2, 600, 400)}}, {5}).edges,
            (Edges{{0, 1}}));
}

TEST(Components, AreDisjointInTheInducedSubgraphLargestFirst) {
  // A path 0 - 1 - 2 - 3 - 4 - 5 - 6 without its vertex 2, and 7 on its own.
  Graph graph;
  graph.neighbors = {{1}, {0, 2}, {1, 3}, {2, 4}, {3, 5}, {4, 6}, {5}, {}};
  EXPECT_EQ(components(graph, {0, 1, 3, 4, 5, 6, 7}),
            (std::vector<std::vector<int>>{{3, 4, 5, 6}, {0, 1}, {7}}));
  EXPECT_EQ(components(graph, {0, 1, 3, 4, 5, 6, 7}, Reach::kAcrossOthers),
            (std::vector<std::vector<int>>{{0, 1, 3, 4, 5, 6}, {7}}))
      << "1 and 3 have 2 in common";
  EXPECT_TRUE(components(graph, {}).empty());
}

}  // namespace
}  // namespace mvo
