// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the time goes: statistics of timing.csv.
#pragma once

#include <string>
#include <vector>

#include "mvo/io/timing_csv.hpp"

namespace mvo {

/// Times of one stage over all frames that have it.
struct StageTime {
  std::string stage;
  int frames = 0;
  double median = 0;  ///< [ms]
  double mean = 0;    ///< [ms]
  double p95 = 0;     ///< [ms]
  double max = 0;     ///< [ms]
};

/// One entry per stage in the order of their first rows, and at the end "step": the frame's "total"
/// row where there is one, else the sum of its stages. Empty for no rows.
std::vector<StageTime> stageTimes(const std::vector<TimingRow>& rows);

}  // namespace mvo
