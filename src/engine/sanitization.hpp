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

/// The labels that are left are consistent enough for the batch. In a `warm` start a label that the
/// last window did not know needs its least number of tracklets in view.
Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const EnergyOptions& energy, const EngineOptions& options,
                        bool warm);

}  // namespace mvo
