// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How long work may go on.
#pragma once

#include <chrono>
#include <optional>
#include <string>

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

/// What a step left out because its time was up.
struct CutShort {
  bool refinement = false;  ///< of proposals, which are as coarse as they were found
  bool rounds = false;      ///< of the label loop
  bool batch = false;       ///< some motions are the last window's and their newest frame pair

  bool any() const { return refinement || rounds || batch; }
  /// "refinement, batch"; empty if nothing was.
  std::string text() const {
    std::string out;
    const auto add = [&out](bool is, const char* name) {
      if (is) out.append(out.empty() ? "" : ", ").append(name);
    };
    add(refinement, "refinement");
    add(rounds, "rounds");
    add(batch, "batch");
    return out;
  }
};

}  // namespace mvo
