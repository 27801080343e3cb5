// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What was learnt of a stereo pair's error, in a file, so that the next run starts from it.
#pragma once

#include <filesystem>

#include "mvo/camera_errors.hpp"

namespace mvo {

/// JSON: camera, names of the terms, mean, covariance. The file appears complete or not at all and
/// replaces an older one. Throws std::runtime_error naming the file if it cannot be written.
void writeCameraErrors(const std::filesystem::path& path, const LearntCameraErrors& learnt);

/// Throws std::runtime_error naming the file if it cannot be read or be such a file.
LearntCameraErrors readCameraErrors(const std::filesystem::path& path);

}  // namespace mvo
