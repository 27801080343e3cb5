// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/graph/graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/core/utility.hpp>

#include "engine/graph/frame_grids.hpp"
#include "engine/graph/image_paths.hpp"

namespace mvo {

namespace {

// The k nearest of those offered, ties to the lower index.
class Nearest {
 public:
  explicit Nearest(int k) : k_(k) {}

  /// Nothing beyond this squared distance is of use.
  float bound() const { return bound_; }
  float reach() const { return reach_; }  // its root
  bool full() const { return static_cast<int>(best_.size()) == k_; }
  void offer(float distance2, int index) {
    const Neighbor candidate{distance2, index};
    if (distance2 < 0 || (full() && !(candidate < best_.back()))) return;
    if (full()) best_.pop_back();
    best_.insert(std::upper_bound(best_.begin(), best_.end(), candidate), candidate);
    if (full() && best_.back().distance2 != bound_) setBound(best_.back().distance2);
  }
  void clear() {
    best_.clear();
    setBound(std::numeric_limits<float>::max());
  }
  void copyTo(int* indices) const {
    for (const Neighbor& n : best_) *indices++ = n.index;
  }

 private:
  struct Neighbor {
    float distance2;
    int index;
    bool operator<(const Neighbor& other) const {
      return distance2 != other.distance2 ? distance2 < other.distance2 : index < other.index;
    }
  };
  void setBound(float distance2) {
    bound_ = distance2;
    reach_ = std::sqrt(distance2);
  }

  int k_;
  float bound_ = std::numeric_limits<float>::max();
  float reach_ = std::numeric_limits<float>::max();
  std::vector<Neighbor> best_;
};

// Two tracklets of which the first ends in frame k share frames only if the other one's span has k.
// So those in a tracklet's own last frame and those that end in its earlier frames are all
// candidates; the distance there is a lower bound of the maximum and rules nearly all of them out.
class NeighborSearch {
 public:
  explicit NeighborSearch(const Window& window)
      : paths_(window),
        present_(present(paths_), paths_.extent(), paths_.frames()),
        ending_(ending(paths_), paths_.extent(), paths_.frames() / kIntervalFrames + 1),
        ending_in_(paths_.frames()) {
    for (int i = 0; i < paths_.tracklets(); ++i) ending_in_[paths_.last(i)].push_back(i);
  }

  void find(int i, Nearest& nearest) const {
    nearest.clear();
    const int last = paths_.last(i);
    const auto offer = [&](int j) {
      if (j == i || paths_.firstDistance2(i, j) > nearest.bound()) return;
      nearest.offer(paths_.maxDistance2(i, j), j);
    };
    const auto near = [&](const ImagePoint& here) {
      return [&](const ImagePoint& there, int j) {
        if (!(here.distance2(there) > nearest.bound())) offer(j);
      };
    };

    // Around where it ends, ring by ring until the bound is known; then as far as that reaches.
    const ImagePoint end = paths_.at(i, last);
    present_.visitUnplaced(last, near(end));
    CellRange seen;
    if (end.isFinite()) {
      const CellRange center = present_.cells(ImageBox::around(end));
      for (int ring = 0; !nearest.full() && !(seen == present_.all()); ++ring) {
        const CellRange block = present_.around(center, ring);
        present_.visit(last, block, seen, near(end));
        seen = block;
      }
    }
    const CellRange reach = end.isFinite()
                                ? present_.cells(ImageBox::around(end).grownBy(nearest.reach()))
                                : present_.all();
    present_.visit(last, reach, seen, near(end));

    // Those that end along its way, an interval at a time; its gaps can rule nobody out.
    const auto seenAlong = [&](int j) {
      const int frame = paths_.last(j);
      return frame >= paths_.first(i) && frame < last && paths_.at(i, frame).isFinite();
    };
    const auto unplaced = [&](const ImagePoint& /*there*/, int j) {
      if (seenAlong(j)) offer(j);
    };
    const auto placed = [&](const ImagePoint& there, int j) {
      if (seenAlong(j) && paths_.at(i, paths_.last(j)).distance2(there) <= nearest.bound())
        offer(j);
    };
    for (int begin = paths_.first(i); begin < last; begin = nextInterval(begin)) {
      const int interval = begin / kIntervalFrames;
      ending_.visitUnplaced(interval, unplaced);
      ImageBox way;
      for (int frame = begin; frame < std::min(last, nextInterval(begin)); ++frame)
        if (paths_.at(i, frame).isFinite()) way.add(ImageBox::around(paths_.at(i, frame)));
      if (way.left <= way.right)
        ending_.visit(interval, ending_.cells(way.grownBy(nearest.reach())), {}, placed);
    }
    if (paths_.hasGaps(i))
      for (int frame = paths_.first(i); frame < last; ++frame)
        if (!paths_.at(i, frame).isFinite())
          for (const int j : ending_in_[frame]) offer(j);
  }

 private:
  static constexpr int kIntervalFrames = 8;  // frames in which tracklets do not move far

  static int nextInterval(int frame) { return (frame / kIntervalFrames + 1) * kIntervalFrames; }
  // Every tracklet in every frame of its span, in gaps too.
  static std::vector<Sighting> present(const ImagePaths& paths) {
    std::vector<Sighting> sightings;
    sightings.reserve(paths.positions());
    for (int i = 0; i < paths.tracklets(); ++i)
      for (int frame = paths.first(i); frame <= paths.last(i); ++frame)
        sightings.push_back({paths.at(i, frame), frame, i});
    return sightings;
  }
  // All last positions, in one image for each interval.
  static std::vector<Sighting> ending(const ImagePaths& paths) {
    std::vector<Sighting> sightings;
    sightings.reserve(paths.tracklets());
    for (int i = 0; i < paths.tracklets(); ++i)
      sightings.push_back({paths.at(i, paths.last(i)), paths.last(i) / kIntervalFrames, i});
    return sightings;
  }

  ImagePaths paths_;
  FrameGrids present_;
  FrameGrids ending_;
  std::vector<std::vector<int>> ending_in_;  // each frame
};

}  // namespace

Graph buildGraph(const Window& window, const GraphOptions& options) {
  const int n = static_cast<int>(window.tracklets.size());
  const NeighborSearch search(window);
  const int k = options.neighbors;
  std::vector<int> nearest(static_cast<std::size_t>(n) * k, -1);
  cv::parallel_for_(cv::Range(0, n), [&](const cv::Range& range) {
    Nearest found(k);
    for (int i = range.start; i < range.end; ++i) {
      search.find(i, found);
      found.copyTo(&nearest[static_cast<std::size_t>(i) * k]);
    }
  });

  Graph graph;
  graph.neighbors.resize(n);
  for (auto& list : graph.neighbors) list.reserve(2 * static_cast<std::size_t>(k));
  const auto nearestOf = [&](int i) {
    return nearest.begin() + static_cast<std::ptrdiff_t>(i) * k;
  };
  for (int i = 0; i < n; ++i)
    for (auto j = nearestOf(i); j != nearestOf(i + 1) && *j >= 0; ++j) {
      graph.neighbors[i].push_back(*j);
      // From both ends once.
      if (std::find(nearestOf(*j), nearestOf(*j + 1), i) == nearestOf(*j + 1))
        graph.neighbors[*j].push_back(i);
    }
  graph.edges.reserve(nearest.size());
  for (int i = 0; i < n; ++i) {
    auto& list = graph.neighbors[i];
    std::sort(list.begin(), list.end());
    for (auto j = std::upper_bound(list.begin(), list.end(), i); j != list.end(); ++j)
      graph.edges.emplace_back(i, *j);
  }
  return graph;
}

std::vector<std::vector<int>> components(const Graph& graph, const std::vector<int>& vertices,
                                         Reach reach) {
  enum : char { kOutside, kWaiting, kTaken };
  std::vector<char> state(graph.neighbors.size(), kOutside);
  for (const int v : vertices) state[v] = kWaiting;
  std::vector<std::vector<int>> all;
  for (const int seed : vertices) {
    if (state[seed] != kWaiting) continue;
    std::vector<int> members{seed};
    state[seed] = kTaken;
    const auto take = [&](int q) {
      if (state[q] != kWaiting) return;
      state[q] = kTaken;
      members.push_back(q);
    };
    std::size_t visited = 0;
    while (visited < members.size()) {
      const int p = members[visited++];
      for (const int q : graph.neighbors[p]) {
        take(q);
        if (reach == Reach::kAcrossOthers && state[q] == kOutside)
          for (const int r : graph.neighbors[q]) take(r);
      }
    }
    std::sort(members.begin(), members.end());
    all.push_back(std::move(members));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return all;
}

}  // namespace mvo
