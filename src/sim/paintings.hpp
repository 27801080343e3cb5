// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Procedural bitmaps with corners at many scales; no two places of a bitmap look alike.
#pragma once

#include <opencv2/core.hpp>

#include "sim/random.hpp"

namespace mvo::sim {

/// Grey range of a painting.
struct Tones {
  double low = 10;
  double high = 245;
};

/// Shapes, strokes and glyphs of every size thrown over a cloudy ground: faces of bodies, posters.
cv::Mat collage(cv::Size size, const Tones& tones, Random random);

/// A brick wall with posters; `poster` is a poster's usual width [px].
cv::Mat wall(cv::Size size, int brick, int poster, Random random);

/// Pebbles of many sizes on cloudy ground, `pebble` being the largest [px]; with `mats` > 0 that
/// many pictures lie on it.
cv::Mat ground(cv::Size size, int pebble, int mats, Random random);

/// Ceiling panels of a width [px] with speckles.
cv::Mat panels(cv::Size size, int panel, Random random);

/// Plaster, or a sky: brightness that varies by `amplitude` about a mean, smoothly, over all sizes
/// up to a quarter of the width.
cv::Mat plaster(cv::Size size, double mean, double amplitude, Random random);

/// A stained vertical board: strokes along the height and knots.
cv::Mat wood(cv::Size size, Random random);

/// A checkerboard whose every square carries marks of its own.
cv::Mat checkerboard(cv::Size size, int columns, int rows, Random random);

}  // namespace mvo::sim
