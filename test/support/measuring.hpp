// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Times of a piece of work, one by one, for the benchmarks that report medians and tails.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace mvo::test {

/// CPU time of all threads of this process, and wall time [ms].
struct Cost {
  double cpu_ms = 0;
  double wall_ms = 0;
};

/// What a piece of work costs.
template <class Work>
Cost costOf(const Work& work) {
  const auto cpu_now = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
  };
  const double cpu = cpu_now();
  const auto wall = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double, std::milli> spent = std::chrono::steady_clock::now() - wall;
  return {cpu_now() - cpu, spent.count()};
}

/// The smallest value that at least this share of the values does not exceed; 0 without values.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(share * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::max(1.0, rank)) - 1];
}

inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// Gives memory that is free back to the system, so that what is used next counts as new.
inline void releaseFreeMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Memory of this process that is resident now [MiB]; 0 where the system does not say.
inline double residentMebibytes() {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
    if (word == "VmRSS:") {
      double kibibytes = 0;
      status >> kibibytes;
      return kibibytes / 1024;
    }
  return 0;
}

}  // namespace mvo::test
