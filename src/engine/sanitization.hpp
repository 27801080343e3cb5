// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-E: the final label set is merged once more, small and short labels and bad tracklets become
// outliers.
#pragma once

#include "engine/residuals.hpp"
#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// The labels that are left are consistent enough for the batch. In a warm start a label that the
/// last window did not know needs `min_seen` tracklets in view, most of its own, and must fit them
/// no worse than the largest label fits its own.
Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const EnergyOptions& energy, const EngineOptions& options,
                        int min_seen, bool warm);

}  // namespace mvo
