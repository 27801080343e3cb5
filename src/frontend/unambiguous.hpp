// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether the place where a point was found is the only one that explains what is seen.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "frontend/common_motion.hpp"

namespace mvo {

/// A place in an image [px].
struct Sight {
  const std::vector<cv::Mat>& pyramid;
  cv::Point2f place;
};

/// Whether what is at one place is at the other one in the next image, and not where that image
/// looks alike: by where it is expected and by how well each place explains its patch of `side` px.
bool isUnambiguous(const Sight& from, const Sight& to, const ExpectedPlace& expected, int side);

}  // namespace mvo
