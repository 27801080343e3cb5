// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Random numbers that are the same on every machine (the distributions of <random> are not).
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>

namespace mvo::sim {

/// splitmix64: one 64-bit state, full period, passes the usual test suites.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// An independent stream per tuple of keys.
  Random(std::initializer_list<std::uint64_t> keys) {
    for (const std::uint64_t key : keys) {
      state_ ^= key;
      state_ = next();
    }
  }

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// In [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  /// In [low, high], both included; low if high is not above it.
  int integer(int low, int high) {
    const auto above_low = static_cast<std::uint64_t>(std::max(high - low, 0));
    return low + static_cast<int>(next() % (above_low + 1));
  }
  /// The value or its negative.
  double eitherSign(double value) { return (next() >> 63) == 0 ? value : -value; }

 private:
  std::uint64_t state_ = 0;
};

}  // namespace mvo::sim
