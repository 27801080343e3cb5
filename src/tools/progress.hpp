// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Progress of long work on stderr: a bar with rate and remaining time.
#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <utility>

namespace mvo_tools {

/// Draws on a terminal, at most ten times a second; elsewhere prints a line every 10 %.
class Progress {
 public:
  /// `what` and `unit` are for the reader: "blocks.bag", "frames". A quiet one prints nothing.
  Progress(std::string what, std::string unit, std::size_t total, bool quiet = false);
  /// Leaves the cursor on a fresh line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` of the total; beyond the total is fine, as is never reaching it.
  void update(std::size_t done);
  /// A line of its own above the bar (also of a quiet one).
  void message(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  void clearLine();
  std::string line(std::size_t done) const;

  std::string what_;
  std::string unit_;
  std::size_t total_;
  bool quiet_;
  bool terminal_;
  bool drawn_ = false;
  std::size_t tenths_ = 0;
  Clock::time_point start_ = Clock::now();
  std::deque<std::pair<Clock::time_point, std::size_t>>
      recent_;  // the rate changes as work goes on
  Clock::time_point last_draw_;
};

}  // namespace mvo_tools
