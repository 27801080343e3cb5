// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Wall time per stage.
#pragma once

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace mvo {

/// Collects (stage, milliseconds); laps of the same stage add up.
class Stopwatch {
 public:
  /// The time since construction or the last lap goes to `stage`.
  void lap(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    for (auto& [name, sum] : laps_)
      if (name == stage) {
        sum += ms;
        return;
      }
    laps_.emplace_back(stage, ms);
  }
  /// Of all laps [ms].
  double total() const {
    double sum = 0;
    for (const auto& lap : laps_) sum += lap.second;
    return sum;
  }
  const std::vector<std::pair<std::string, double>>& laps() const { return laps_; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::vector<std::pair<std::string, double>> laps_;
};

}  // namespace mvo
