// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the time goes: statistics of timing.csv.
#pragma once

#include <vector>

#include "mvo/evaluation.hpp"

namespace mvo {

/// One entry per stage in the order of their first rows, and at the end "step": the frame's "total"
/// row where there is one, else the sum of its stages. Empty for no rows.
std::vector<StageTime> stageTimes(const std::vector<TimingRow>& rows);

}  // namespace mvo
