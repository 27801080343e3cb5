// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// timing.csv: how long every stage took in every frame.
#pragma once

#include <filesystem>
#include <vector>

#include "mvo/trajectory_files.hpp"

namespace mvo {

/// Columns stamp,stage,ms. Throws std::runtime_error naming file and line.
std::vector<TimingRow> readTimings(const std::filesystem::path& path);

/// The file appears complete or not at all. Throws std::runtime_error naming the file.
void writeTimings(const std::filesystem::path& path, const std::vector<TimingRow>& rows);

}  // namespace mvo
