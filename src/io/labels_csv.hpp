// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// labels.csv: which motion every tracklet seen in a frame was found to belong to.
#pragma once

#include <filesystem>
#include <vector>

#include "mvo/trajectory_files.hpp"

namespace mvo {

/// Columns stamp,tracklet_id,u,v,motion_id. Throws std::runtime_error naming file and line.
std::vector<LabelRow> readLabels(const std::filesystem::path& path);

}  // namespace mvo
