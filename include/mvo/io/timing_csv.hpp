// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// timing.csv: how long every stage took in every frame.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace mvo {

/// One stage in one frame.
struct TimingRow {
  std::int64_t stamp_ns = 0;
  std::string stage;
  double ms = 0;  ///< wall time
};

/// Columns stamp,stage,ms. Throws std::runtime_error naming file and line.
std::vector<TimingRow> readTimings(const std::filesystem::path& path);

/// The file appears complete or not at all. Throws std::runtime_error naming the file.
void writeTimings(const std::filesystem::path& path, const std::vector<TimingRow>& rows);

}  // namespace mvo
