// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which pixels of the left image are not to be looked at, as a user gives them: a hood, an arm, a
// logo.
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace mvo_ros {

struct Mask {
  cv::Mat image;       ///< 8UC1, 0 = not to be looked at; empty: all is looked at
  std::string source;  ///< what a complaint begins with
};

/// Reads an image file. Throws std::runtime_error, one sentence that names it, if it is no image or
/// leaves out everything.
Mask readMask(const std::string& path);

/// Throws std::runtime_error, one sentence that names the mask's source and both sizes, if a mask
/// is not of the left image's size.
void requireSize(const Mask& mask, const cv::Size& left);

}  // namespace mvo_ros
