// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A lens with distortion: every sample has its own ray, and nothing is linear along a row.
#pragma once

#include <vector>

#include "sim/eye.hpp"
#include "sim/raster.hpp"

namespace mvo::sim {

/// Where the samples of some rows of a grid look: `points` are the coordinates in the same grid
/// that would see the same without distortion, row by row.
struct BentRays {
  Rows rows;
  std::vector<Eigen::Vector2d> points;
};

/// The rays of a grid with n x n samples per pixel of an eye.
BentRays bentRays(const Eye& eye, int n, const Rows& rows);

/// The nearest face of every sample of the rays' rows.
Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid,
                      const BentRays& rays);

}  // namespace mvo::sim
