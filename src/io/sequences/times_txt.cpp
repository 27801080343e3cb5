// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/sequences/times_txt.hpp"

#include <stdexcept>

#include "io/text_lines.hpp"

namespace mvo {

std::vector<FrameTime> readTimes(const std::filesystem::path& path) {
  LineReader lines(path);
  std::vector<FrameTime> times;
  while (lines.next()) {
    const FrameTime time{lines.integer(0), lines.stamp(1)};
    if (!times.empty() && time.stamp_ns <= times.back().stamp_ns)
      lines.fail("the stamp does not increase");
    times.push_back(time);
  }
  if (times.empty()) throw std::runtime_error(path.string() + " has no frames");
  return times;
}

}  // namespace mvo
