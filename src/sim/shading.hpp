// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Light and texture of the samples, summed into pixels; the sensor's noise.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "sim/raster.hpp"

namespace mvo::sim {

/// Adds weight x brightness of every sample to its pixel of `sum`, which has n x n samples per
/// pixel and one channel (grey) or three (blue, green, red), 32F.
void shade(const std::vector<ProjectedFace>& faces, const Visibility& seen, int n, float weight,
           cv::Mat& sum);

/// gain x image + normal noise of a standard deviation, rounded to 8 bits. The seed decides the
/// noise.
cv::Mat expose(const cv::Mat& image, double gain, double noise, std::uint64_t seed);

}  // namespace mvo::sim
