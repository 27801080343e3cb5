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

/// The labels that are left are consistent enough for the batch. Labels with a serial number below
/// `known` come from the last window; with any of them (a warm start), a new label needs its
/// minimum of tracklets in view and must fit them no worse than the largest label fits its own.
Labeling sanitizeLabels(const Window& window, const Graph& graph, ResidualCache& residuals,
                        Labeling labels, const Options& options, int known = 0);

}  // namespace mvo
