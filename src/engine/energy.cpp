// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "engine/energy.hpp"

#include <cassert>

namespace mvo {

double Energy::evaluate(const std::vector<int>& assignment) const {
  assert(static_cast<int>(assignment.size()) == tracklets());
  double residual = 0;
  std::vector<char> used(static_cast<std::size_t>(data.cols()), 0);
  for (int p = 0; p < tracklets(); ++p) {
    const int l = assignment[p];
    assert(l >= 0 && l <= outlier());
    residual += data(p, l);
    used[l] = 1;
  }
  double smoothness = 0;
  for (const Edge& e : edges)
    if (assignment[e.p] != assignment[e.q]) smoothness += e.weight;
  double complexity = 0;
  for (int l = 0; l <= outlier(); ++l)
    if (used[l]) complexity += label_cost[l];
  return residual + smoothness + complexity;
}

}  // namespace mvo
