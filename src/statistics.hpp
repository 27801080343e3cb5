// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Order statistics: always one of the values themselves, never a mean of two.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace mvo {

/// The value with `rank` others before it in increasing order; rank < values.size().
template <typename T>
T valueOfRank(std::vector<T> values, std::size_t rank) {
  assert(rank < values.size());
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

/// The value in the middle, the upper one of an even number; there must be one.
template <typename T>
T median(std::vector<T> values) {
  const std::size_t middle = values.size() / 2;
  return valueOfRank(std::move(values), middle);
}

/// The smallest value that at least this share of the values does not exceed (for 0.5 and an even
/// number: the lower one in the middle); 0 without values.
template <typename T>
T quantile(std::vector<T> values, double share) {
  if (values.empty()) return T{};
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return valueOfRank(std::move(values), static_cast<std::size_t>(std::max(rank, 1.0)) - 1);
}

}  // namespace mvo
