// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// labels.csv: which motion every tracklet seen in a frame was found to belong to.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace mvo {

/// One tracklet in one frame, with the label as known at that frame.
struct LabelRow {
  std::int64_t stamp_ns = 0;
  std::int64_t tracklet = 0;
  double u = 0;       ///< in the rectified left image [px]
  double v = 0;       ///< [px]
  int motion_id = 0;  ///< 0 = static world, >= 1 a moving body, -1 = outlier
};

/// Columns stamp,tracklet_id,u,v,motion_id. Throws std::runtime_error naming file and line.
std::vector<LabelRow> readLabels(const std::filesystem::path& path);

/// The file appears complete or not at all. Throws std::runtime_error naming the file.
void writeLabels(const std::filesystem::path& path, const std::vector<LabelRow>& rows);

}  // namespace mvo
