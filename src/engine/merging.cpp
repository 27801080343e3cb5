// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/merging.hpp"

#include <algorithm>
#include <limits>

namespace mvo {

namespace {

struct Span {
  FrameId first = std::numeric_limits<FrameId>::max();
  FrameId last = std::numeric_limits<FrameId>::min();
};

// The working state of a merge: supports, their spans in time and their mutual edges shrink as
// labels vanish.
class Merger {
 public:
  Merger(const Window& window, const Graph& graph, const ResidualTable& table, Labeling labels,
         const EnergyOptions& options, MergeScope scope)
      : window_(window),
        graph_(graph),
        table_(table),
        labels_(std::move(labels)),
        options_(options),
        scope_(scope) {
    for (std::size_t p = 0; p < labels_.assignment.size(); ++p)
      if (labels_.assignment[p] != kOutlier)
        cost_.push_back(dataCost(table_.worst(p, labels_.assignment[p]), options_));
      else
        cost_.push_back(0);
  }

  bool mergeBest() {
    const int count = static_cast<int>(labels_.labels.size());
    supports_.clear();
    for (int l = 0; l < count; ++l) supports_.push_back(labels_.support(l));
    std::vector<std::vector<int>> edges(count, std::vector<int>(count, 0));
    for (const auto& [p, q] : graph_.edges) {
      const int a = labels_.assignment[p];
      const int b = labels_.assignment[q];
      if (a == kOutlier || b == kOutlier || a == b) continue;
      ++edges[a][b];
      ++edges[b][a];
    }
    double best = -1e-9;
    std::pair<int, int> which{-1, -1};
    for (int from = 0; from < count; ++from)
      for (int to = 0; to < count; ++to) {
        if (from == to || supports_[from].empty() || supports_[to].empty()) continue;
        // Over the shared time alone a brief label would swallow a long one; the longer one's
        // motion must hold for both.
        if (labels_.labels[to].trajectory.T_ck_c1.size() <
            labels_.labels[from].trajectory.T_ck_c1.size())
          continue;
        if (scope_ == MergeScope::kAdjacent && edges[from][to] == 0) continue;
        if (!overlap(span(supports_[from]), span(supports_[to]))) continue;
        const double change =
            residualChange(from, to) - options_.label_cost - options_.smoothness * edges[from][to];
        if (change < best) {
          best = change;
          which = {from, to};
        }
      }
    if (which.first < 0) return false;
    for (const int p : supports_[which.first]) {
      cost_[p] = dataCost(table_.overlap(p, which.second), options_);
      labels_.assignment[p] = which.second;
    }
    return true;
  }

  Labeling result() && { return std::move(labels_); }

 private:
  Span span(const std::vector<int>& support) const {
    Span s;
    for (const int p : support) {
      s.first = std::min(s.first, window_.tracklets[p].first());
      s.last = std::max(s.last, window_.tracklets[p].last());
    }
    return s;
  }
  static bool overlap(const Span& a, const Span& b) {
    return std::min(a.last, b.last) > std::max(a.first, b.first);
  }

  // A tracklet that shares no pair with the label cannot speak against it; some must, though.
  double residualChange(int from, int to) const {
    double change = 0;
    int witnesses = 0;
    for (const int p : supports_[from]) {
      const double residual = table_.overlap(p, to);
      if (residual >= Energy::kInadmissible) continue;
      ++witnesses;
      change += dataCost(residual, options_) - cost_[p];
    }
    return 2 * witnesses > static_cast<int>(supports_[from].size())
               ? change
               : std::numeric_limits<double>::infinity();
  }

  const Window& window_;
  const Graph& graph_;
  const ResidualTable& table_;
  Labeling labels_;
  const EnergyOptions& options_;
  MergeScope scope_;
  std::vector<double> cost_;
  std::vector<std::vector<int>> supports_;
};

}  // namespace

Labeling mergeLabels(const Window& window, const Graph& graph, const ResidualTable& table,
                     Labeling labels, const EnergyOptions& options, MergeScope scope) {
  Merger merger(window, graph, table, std::move(labels), options, scope);
  while (merger.mergeBest()) {
  }
  return std::move(merger).result();
}

Labeling dropEmptyLabels(Labeling labels) {
  std::vector<int> size(labels.labels.size(), 0);
  for (const int l : labels.assignment)
    if (l != kOutlier) ++size[l];
  std::vector<int> renumbered(labels.labels.size(), kOutlier);
  std::vector<Label> kept;
  for (std::size_t l = 0; l < labels.labels.size(); ++l)
    if (size[l] > 0) {
      renumbered[l] = static_cast<int>(kept.size());
      kept.push_back(std::move(labels.labels[l]));
    }
  labels.labels = std::move(kept);
  for (int& l : labels.assignment)
    if (l != kOutlier) l = renumbered[l];
  return labels;
}

}  // namespace mvo
