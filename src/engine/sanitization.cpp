// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/sanitization.hpp"

#include <algorithm>

#include "engine/merging.hpp"

namespace mvo {

namespace {

constexpr double kNewcomerInView = 0.75;  // share of a new label's tracklets that must be in view
constexpr double kLooserNewcomer = 2;  // how much looser than the largest label a clear one may fit
constexpr double kClearNewcomer = 75;  // residual under the known labels over that under its own

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
Labeling dropDoubtfulNewcomers(const Window& window, const ResidualTable& table, Labeling labels,
                               int known, const Options& options) {
  if (known == 0) return labels;
  const int count = static_cast<int>(labels.labels.size());
  std::vector<std::vector<int>> supports;
  std::vector<int> known_labels;
  int largest = 0;
  for (int l = 0; l < count; ++l) {
    supports.push_back(labels.support(l));
    if (supports[l].size() > supports[largest].size()) largest = l;
    if (labels.labels[l].serial < known) known_labels.push_back(l);
  }
  if (count == 0) return labels;
  const double loosest = std::max(typicalResidual(supports[largest], table.overlap.col(largest)),
                                  options.energy.typical_residual);
  for (int l = 0; l < count; ++l) {
    if (labels.labels[l].serial < known || l == largest) continue;
    const std::vector<int>& support = supports[l];
    const auto in_view = std::count_if(support.begin(), support.end(), [&window](int p) {
      return window.tracklets[p].last() == window.last_frame;
    });
    const bool is_seen =
        in_view >= options.proposal.min_support &&
        static_cast<double>(in_view) >= kNewcomerInView * static_cast<double>(support.size());
    const double typical = typicalResidual(support, table.overlap.col(l));
    if (is_seen && (typical <= loosest ||
                    (typical <= kLooserNewcomer * loosest &&
                     residualUnderKnown(table, support, known_labels) >= kClearNewcomer * typical)))
      continue;
    for (const int p : support) labels.assignment[p] = kOutlier;
  }
  return labels;
}

}  // namespace

Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const Options& options, int known) {
  const ResidualTable table = residuals.table(labels.labels);
  labels = mergeLabels(window, graph, table, std::move(labels), options.energy, MergeScope::kAny);
  for (std::size_t p = 0; p < labels.assignment.size(); ++p) {
    const int l = labels.assignment[p];
    if (l != kOutlier && table.overlap(p, l) > options.energy.threshold)
      labels.assignment[p] = kOutlier;
  }
  // Counting last covers both of the paper's checks: losing bad tracklets can make a label too
  // small.
  labels = dropDoubtfulNewcomers(window, table, std::move(labels), known, options);
  return dropSmallLabels(window, dropEmptyLabels(std::move(labels)), options.engine);
}

}  // namespace mvo
