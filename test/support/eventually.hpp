// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Waiting for a condition, never for a time.
#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace mvo::test {

constexpr double kPatience = 60;  // s; far beyond what instrumented programs need

/// Whether a condition comes true before the deadline.
inline bool eventually(const std::function<bool()>& condition, double seconds = kPatience) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (Clock::now() > deadline) return condition();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

}  // namespace mvo::test
