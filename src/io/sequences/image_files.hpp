// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Numbered images of a sequence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core.hpp>
#include <string>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// NNNNNN, as images are numbered.
std::string sixDigits(std::int64_t number);

/// The image <folder>/<stem>.<any of png, jpg, jpeg, pgm>, read as cv::imread's flags say. Throws
/// std::runtime_error if it is not there, cannot be decoded, or has another size than the camera.
cv::Mat readImage(const std::filesystem::path& folder, const std::string& stem, int flags,
                  const StereoCamera& camera);

/// The size of an image. Throws std::runtime_error.
cv::Size imageSize(const std::filesystem::path& folder, const std::string& stem);

}  // namespace mvo
