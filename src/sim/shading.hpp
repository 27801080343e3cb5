// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light and texture of the samples, summed into pixels.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "sim/bent_rays.hpp"
#include "sim/raster.hpp"

namespace mvo::sim {

/// Adds weight x brightness of every sample seen to its pixel of `sum`, which has n x n samples per
/// pixel and one channel (grey) or three (blue, green, red), 32F. With a lens that bends, `rays`
/// are those of the rows seen.
void shade(const std::vector<ProjectedFace>& faces, const Visibility& seen, int n, float weight,
           cv::Mat& sum, const BentRays* rays = nullptr);

}  // namespace mvo::sim
