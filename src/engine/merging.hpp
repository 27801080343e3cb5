// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-D: greedy merging of labels that are redundant under Eq. (2).
#pragma once

#include "engine/residuals.hpp"
#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

enum class MergeScope { kAdjacent, kAny };

/// Relabels whole supports, best gain first, both directions tried, without refit, as long as the
/// energy falls; residuals count over the shared time only. kAdjacent: only labels joined by an
/// edge of the graph (III-D); kAny: regardless (III-E). Labels whose supports share no frame pair
/// are never merged; the outlier label is excluded. Never raises the energy.
Labeling mergeLabels(const Window& window, const Graph& graph, const ResidualTable& table,
                     Labeling labels, const EnergyOptions& options, MergeScope scope);

/// Drops labels without support and renumbers the assignment.
Labeling dropEmptyLabels(Labeling labels);

}  // namespace mvo
