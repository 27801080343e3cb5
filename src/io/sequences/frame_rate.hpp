// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The rate of a sequence from its stamps.
#pragma once

#include <cstdint>
#include <vector>

namespace mvo {

/// Frames per second over all stamps; 0 for fewer than two.
inline double frameRate(const std::vector<std::int64_t>& stamps_ns) {
  if (stamps_ns.size() < 2) return 0;
  return 1e9 * static_cast<double>(stamps_ns.size() - 1) /
         static_cast<double>(stamps_ns.back() - stamps_ns.front());
}

}  // namespace mvo
