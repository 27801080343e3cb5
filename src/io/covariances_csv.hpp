// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// covariances.csv: how well every motion is known in every frame.
#pragma once

#include <filesystem>
#include <vector>

#include "mvo/trajectory_files.hpp"

namespace mvo {

/// Columns stamp,motion_id,span,from_stamp, tx..tz,qx..qw of T_cb_ca, and the upper triangle
/// c00,c01..c55 of its covariance row by row; span is step, window or all. Throws
/// std::runtime_error naming file and line.
std::vector<MotionCovariance> readCovariances(const std::filesystem::path& path);

/// The file appears complete or not at all. Throws std::runtime_error naming the file.
void writeCovariances(const std::filesystem::path& path, const std::vector<MotionCovariance>& rows);

}  // namespace mvo
