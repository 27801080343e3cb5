// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trajectories in the TUM format: "timestamp tx ty tz qx qy qz qw", one pose per line.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace mvo {

/// A pose at a time.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// Comments (#) are skipped, quaternions normalized. Throws std::runtime_error naming file and line
/// of what cannot be a pose or of a stamp that does not increase.
std::vector<StampedPose> readTum(const std::filesystem::path& path);

/// Stamps with nine decimals, poses with twelve significant digits. The file appears complete or
/// not at all. Throws std::runtime_error naming the file if it cannot be written.
void writeTum(const std::filesystem::path& path, const std::vector<StampedPose>& poses);

}  // namespace mvo
