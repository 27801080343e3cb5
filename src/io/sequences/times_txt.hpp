// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// times.txt of a sequence folder: which frames there are and when they were taken.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mvo {

/// One line "number stamp".
struct FrameTime {
  std::int64_t number = 0;  ///< also the name of its images, NNNNNN
  std::int64_t stamp_ns = 0;
};

/// Throws std::runtime_error naming file and line, also for an empty file or a stamp that does not
/// increase.
std::vector<FrameTime> readTimes(const std::filesystem::path& path);

}  // namespace mvo
