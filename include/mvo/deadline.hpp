// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How long work may go on.
#pragma once

#include <chrono>
#include <optional>

namespace mvo {

/// A time by which work should be done; default: there is none. Whoever asks decides what to leave
/// out, so results then depend on the machine's speed.
class Deadline {
 public:
  Deadline() = default;
  /// So many milliseconds from now; 0: none.
  static Deadline after(double ms) {
    Deadline deadline;
    if (ms > 0)
      deadline.at_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double, std::milli>(ms));
    return deadline;
  }
  bool passed() const { return at_ && Clock::now() >= *at_; }

 private:
  using Clock = std::chrono::steady_clock;

  std::optional<Clock::time_point> at_;
};

}  // namespace mvo
