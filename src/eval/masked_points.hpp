// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tracklet observations against the true masks: the one table that association, identity and
// segmentation scores are made of.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "mvo/evaluation.hpp"

namespace mvo {

/// A tracklet observation and what it truly lies on.
struct MaskedPoint {
  std::int64_t tracklet = 0;
  int id = 0;                ///< estimated motion: -1, 0 or >= 1
  int body = 0;              ///< the mask there: 0 static, >= 1 a body
  bool near_border = false;  ///< within 2 px of a pixel with another mask value
};

/// Looks the labels of a frame up in its mask (8UC1), at the nearest pixel; labels outside of the
/// image are left out.
std::vector<MaskedPoint> maskPoints(const std::vector<LabelRow>& labels, const cv::Mat& mask);

/// One entry per frame.
using MaskedFrames = std::vector<std::vector<MaskedPoint>>;

/// An id belongs to what the plurality of its observations over all frames lies on (on a tie: the
/// lower number). Id 0 is the static world by definition; ids never seen on a mask have no entry.
Association associate(const MaskedFrames& frames);

}  // namespace mvo
