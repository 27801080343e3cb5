// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Times of a piece of work, one by one, for the benchmarks that report medians and tails.
#pragma once

#include <chrono>
#include <ctime>
#include <fstream>
#include <string>
#include <utility>
#include <vector>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "statistics.hpp"

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

using mvo::quantile;

/// The lower one in the middle of an even number; 0 without values.
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
