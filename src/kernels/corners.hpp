// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How much of a corner each pixel of a row is, eight pixels at a time.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mvo {

/// Side of the neighbourhood whose gradients make a corner [px].
constexpr int kCornerBlock = 5;

/// Products of the gradients (Sobel's) of `width` >= kFloats pixels of a row
/// [(grey levels / px)^2]; reads one pixel more on every side.
void gradientProducts(const std::uint8_t* row, std::ptrdiff_t step, int width, float* xx, float* xy,
                      float* yy);

/// Smaller eigenvalue of the mean of each pixel's block of products; rows[k] are five rows of xx,
/// xy and yy, each from two pixels left of the first score. `columns` is room for three rows.
/// `width` >= kFloats.
void cornerScores(const float* const (&rows)[3][kCornerBlock], int width, float* columns,
                  float* scores);

/// Marks (non-zero) the scores of the middle row that are above `least` and no less than their
/// eight neighbours; reads one score more on both sides. `width` >= kFloats.
void markPeaks(const float* const (&rows)[3], int width, float least, std::uint8_t* marks);

}  // namespace mvo
