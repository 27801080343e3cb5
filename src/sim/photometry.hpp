// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From light to an image file: lamps, exposure, focus, noise and compression.
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "sim/eye.hpp"

namespace mvo::sim {

/// Brightness of the lamps and the exposure of a row of a frame, 1 as a rule.
double exposureOf(const Scene& scene, int frame, double row_time);

/// gain x image + normal noise of a standard deviation, rounded to 8 bits. The seed decides the
/// noise.
cv::Mat expose(const cv::Mat& image, double gain, double noise, std::uint64_t seed);

/// The 8-bit image of what an eye saw in a frame; 8UC1 or 8UC3. Takes the light's pixels over.
cv::Mat develop(cv::Mat light, const Scene& scene, int frame, const Eye& eye);

}  // namespace mvo::sim
