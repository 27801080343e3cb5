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

// A motion that the last window did not know is about what is there to be seen; what has gone out
// of view was judged while it was in view.
Labeling dropUnseenNewcomers(const Window& window, Labeling labels, int min_seen) {
  for (int l = 0; l < static_cast<int>(labels.labels.size()); ++l) {
    if (labels.labels[l].known) continue;
    const std::vector<int> support = labels.support(l);
    const auto seen = std::count_if(support.begin(), support.end(), [&window](int p) {
      return window.tracklets[p].last() == window.last_frame;
    });
    if (seen >= min_seen) continue;
    for (const int p : support) labels.assignment[p] = kOutlier;
  }
  return labels;
}

}  // namespace

Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const EnergyOptions& energy, const EngineOptions& options,
                        bool warm) {
  const ResidualTable table = residuals.table(labels.labels);
  labels = mergeLabels(window, graph, table, std::move(labels), energy, MergeScope::kAny);
  for (std::size_t p = 0; p < labels.assignment.size(); ++p) {
    const int l = labels.assignment[p];
    if (l != kOutlier && table.overlap(p, l) > energy.threshold) labels.assignment[p] = kOutlier;
  }
  // Counting last covers both of the paper's checks: losing bad tracklets can make a label too
  // small.
  if (warm) labels = dropUnseenNewcomers(window, std::move(labels), options.min_tracklets);
  return dropSmallLabels(window, dropEmptyLabels(std::move(labels)), options);
}

}  // namespace mvo
