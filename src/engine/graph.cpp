// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mvo/engine/graph.hpp"

#include <algorithm>
#include <limits>
#include <opencv2/core/utility.hpp>

namespace mvo {

namespace {

// Image positions of one tracklet, one entry per frame of its span; missing frames are marked.
struct Path {
  FrameId first = 0;
  std::vector<Eigen::Vector2f> uv;
};

constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

struct Neighbor {
  float distance2;
  int index;
  bool operator<(const Neighbor& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : index < other.index;
  }
};

// The largest squared distance over common frames; stops early above `bound`. Negative if no frame
// is common.
float maxDistance2(const Path& p, const Path& q, float bound) {
  const FrameId first = std::max(p.first, q.first);
  const FrameId last = std::min(p.first + static_cast<FrameId>(p.uv.size()),
                                q.first + static_cast<FrameId>(q.uv.size())) -
                       1;
  float largest = -1;
  for (FrameId k = last; k >= first; --k) {
    const float d2 = (p.uv[k - p.first] - q.uv[k - q.first]).squaredNorm();
    if (d2 > largest) {  // false for missing frames
      largest = d2;
      if (largest > bound) return largest;
    }
  }
  return largest;
}

// Who is where, frame by frame. Two tracklets that share a frame share the one in which the first
// of them ends, so looking at a tracklet's own last frame and at those that end in its earlier
// frames finds every candidate; the distance there is a lower bound of the maximum and rules nearly
// all of them out.
class Census {
 public:
  struct Entry {
    Eigen::Vector2f uv;  // missing in a gap
    int index;
  };

  Census(const std::vector<Path>& paths, FrameId first, int frames)
      : first_(first), present_(frames), ending_(frames) {
    for (int i = 0; i < static_cast<int>(paths.size()); ++i) {
      const Path& p = paths[i];
      for (std::size_t k = 0; k < p.uv.size(); ++k)
        present_[p.first - first_ + k].push_back({p.uv[k], i});
      ending_[p.first - first_ + p.uv.size() - 1].push_back({p.uv.back(), i});
    }
  }
  const std::vector<Entry>& present(FrameId frame) const { return present_[frame - first_]; }
  const std::vector<Entry>& ending(FrameId frame) const { return ending_[frame - first_]; }

 private:
  FrameId first_;
  std::vector<std::vector<Entry>> present_;
  std::vector<std::vector<Entry>> ending_;
};

std::vector<int> nearest(const std::vector<Path>& paths, const Census& census, int i, int k) {
  std::vector<Neighbor> best;
  float bound = std::numeric_limits<float>::max();
  const auto offer = [&](const Census::Entry& entry, const Eigen::Vector2f& here) {
    if (entry.index == i || (entry.uv - here).squaredNorm() > bound) return;
    const Neighbor candidate{maxDistance2(paths[i], paths[entry.index], bound), entry.index};
    if (candidate.distance2 < 0 ||
        (static_cast<int>(best.size()) == k && !(candidate < best.back())))
      return;
    best.insert(std::upper_bound(best.begin(), best.end(), candidate), candidate);
    if (static_cast<int>(best.size()) > k) best.pop_back();
    if (static_cast<int>(best.size()) == k) bound = best.back().distance2;
  };
  const Path& path = paths[i];
  const FrameId last = path.first + static_cast<FrameId>(path.uv.size()) - 1;
  for (const auto& entry : census.present(last)) offer(entry, path.uv.back());
  for (FrameId frame = last - 1; frame >= path.first; --frame)
    for (const auto& entry : census.ending(frame)) offer(entry, path.uv[frame - path.first]);
  std::vector<int> indices;
  indices.reserve(best.size());
  for (const Neighbor& n : best) indices.push_back(n.index);
  return indices;
}

}  // namespace

Graph buildGraph(const Window& window, const GraphOptions& options) {
  const int n = static_cast<int>(window.tracklets.size());
  std::vector<Path> paths(n);
  for (int i = 0; i < n; ++i) {
    const Tracklet& t = window.tracklets[i];
    paths[i].first = t.first();
    paths[i].uv.assign(t.last() - t.first() + 1, Eigen::Vector2f(kMissing, kMissing));
    for (const Observation& o : t.observations)
      paths[i].uv[o.frame - t.first()] = o.y.head<2>().cast<float>();
  }
  const Census census(paths, window.first_frame, std::max(0, window.frames()));
  std::vector<std::vector<int>> directed(n);
  cv::parallel_for_(cv::Range(0, n), [&](const cv::Range& range) {
    for (int i = range.start; i < range.end; ++i)
      directed[i] = nearest(paths, census, i, options.neighbors);
  });

  Graph graph;
  graph.neighbors.resize(n);
  for (int i = 0; i < n; ++i)
    for (const int j : directed[i]) graph.edges.emplace_back(std::min(i, j), std::max(i, j));
  std::sort(graph.edges.begin(), graph.edges.end());
  graph.edges.erase(std::unique(graph.edges.begin(), graph.edges.end()), graph.edges.end());
  for (const auto& [p, q] : graph.edges) {
    graph.neighbors[p].push_back(q);
    graph.neighbors[q].push_back(p);
  }
  for (auto& list : graph.neighbors) std::sort(list.begin(), list.end());
  return graph;
}

std::vector<std::vector<int>> components(const Graph& graph, const std::vector<int>& vertices) {
  enum : char { kOutside, kWaiting, kTaken };
  std::vector<char> state(graph.neighbors.size(), kOutside);
  for (const int v : vertices) state[v] = kWaiting;
  std::vector<std::vector<int>> all;
  for (const int seed : vertices) {
    if (state[seed] != kWaiting) continue;
    std::vector<int> members{seed};
    state[seed] = kTaken;
    for (std::size_t i = 0; i < members.size(); ++i)
      for (const int q : graph.neighbors[members[i]])
        if (state[q] == kWaiting) {
          state[q] = kTaken;
          members.push_back(q);
        }
    std::sort(members.begin(), members.end());
    all.push_back(std::move(members));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return all;
}

}  // namespace mvo
