// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/sanitization.hpp"

#include <algorithm>

#include "engine/merging.hpp"

namespace mvo {

namespace {

// Frames in which a support is seen at all.
int length(const Window& window, const std::vector<int>& support) {
  std::vector<char> seen(window.frames(), 0);
  for (const int p : support)
    for (const Observation& o : window.tracklets[p].observations)
      seen[o.frame - window.first_frame] = 1;
  return static_cast<int>(std::count(seen.begin(), seen.end(), 1));
}

Labeling dropSmallLabels(const Window& window, Labeling labels, const EngineOptions& options) {
  // A window that is itself shorter than the minimum holds whatever motion there is.
  const int min_frames = std::min(options.min_frames, window.frames());
  for (int l = 0; l < static_cast<int>(labels.labels.size()); ++l) {
    const std::vector<int> support = labels.support(l);
    if (static_cast<int>(support.size()) >= options.min_tracklets &&
        length(window, support) >= min_frames)
      continue;
    for (const int p : support) labels.assignment[p] = kOutlier;
  }
  return dropEmptyLabels(std::move(labels));
}

// Median residual of a support under whichever known label suits each tracklet best.
double residualUnderKnown(const ResidualTable& table, const std::vector<int>& support,
                          const std::vector<int>& known) {
  Eigen::VectorXd best = Eigen::VectorXd::Constant(table.overlap.rows(), Energy::kInadmissible);
  for (const int l : known)
    for (const int p : support) best(p) = std::min(best(p), table.overlap(p, l));
  return typicalResidual(support, best);
}

// Points that slide along silhouettes and crossings, or are lost in a jerk, gather into brief
// motions: a few live points, many dead ones, a loose fit. A motion that is new while others are
// known must be there to be seen, and must fit its points, followed for a shorter time, no worse
// than the largest motion fits its own; somewhat worse if no known motion comes anywhere near.
class NewcomerTest {
 public:
  NewcomerTest(const Window& window, const ResidualTable& table, const Labeling& labels,
               const EngineOptions& options, double typical_residual, int min_seen)
      : window_(window), table_(table), labels_(labels), options_(options), min_seen_(min_seen) {
    for (int l = 0; l < static_cast<int>(labels.labels.size()); ++l) {
      supports_.push_back(labels.support(l));
      if (supports_[l].size() > supports_[largest_].size()) largest_ = l;
      if (labels.labels[l].known) known_.push_back(l);
    }
    if (supports_.empty()) return;
    loosest_ = std::max(typicalResidual(supports_[largest_], table.overlap.col(largest_)),
                        typical_residual);
  }

  bool isDoubtful(int l) const {
    if (labels_.labels[l].known || l == largest_) return false;
    return !isSeen(supports_[l]) || !fits(l);
  }

 private:
  bool isSeen(const std::vector<int>& support) const {
    const auto in_view = std::count_if(support.begin(), support.end(), [this](int p) {
      return window_.tracklets[p].last() == window_.last_frame;
    });
    return in_view >= min_seen_ &&
           static_cast<double>(in_view) >=
               options_.newcomer_in_view * static_cast<double>(support.size());
  }
  bool fits(int l) const {
    const double typical = typicalResidual(supports_[l], table_.overlap.col(l));
    return typical <= loosest_ || (typical <= options_.newcomer_fit * loosest_ &&
                                   residualUnderKnown(table_, supports_[l], known_) >=
                                       options_.newcomer_distance * typical);
  }

  const Window& window_;
  const ResidualTable& table_;
  const Labeling& labels_;
  const EngineOptions& options_;
  int min_seen_;
  int largest_ = 0;
  double loosest_ = 0;  // residual that still fits [px]
  std::vector<std::vector<int>> supports_;
  std::vector<int> known_;
};

Labeling dropDoubtfulNewcomers(const Window& window, const ResidualTable& table, Labeling labels,
                               const EngineOptions& options, double typical_residual,
                               int min_seen) {
  const NewcomerTest test(window, table, labels, options, typical_residual, min_seen);
  std::vector<char> doubtful;
  doubtful.reserve(labels.labels.size());
  for (int l = 0; l < static_cast<int>(labels.labels.size()); ++l)
    doubtful.push_back(test.isDoubtful(l) ? 1 : 0);
  for (int& l : labels.assignment)
    if (l != kOutlier && doubtful[l] != 0) l = kOutlier;
  return labels;
}

}  // namespace

Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const EnergyOptions& energy, const EngineOptions& options,
                        int min_seen, bool warm) {
  const ResidualTable table = residuals.table(labels.labels);
  labels = mergeLabels(window, graph, table, std::move(labels), energy, MergeScope::kAny);
  for (std::size_t p = 0; p < labels.assignment.size(); ++p) {
    const int l = labels.assignment[p];
    if (l != kOutlier && table.overlap(p, l) > energy.threshold) labels.assignment[p] = kOutlier;
  }
  // Counting last covers both of the paper's checks: losing bad tracklets can make a label too
  // small.
  if (warm)
    labels = dropDoubtfulNewcomers(window, table, std::move(labels), options,
                                   energy.typical_residual, min_seen);
  return dropSmallLabels(window, dropEmptyLabels(std::move(labels)), options);
}

}  // namespace mvo
