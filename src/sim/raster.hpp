// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Which face is seen where: convex polygons into a depth buffer. Inverse depth and texel
// coordinates over depth are linear in the image, so that rows are filled without a division.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "mvo/sim.hpp"

namespace mvo::sim {

/// A pinhole's grid of samples, at whole coordinates from (0, 0) to (width - 1, height - 1).
struct Grid {
  double fu = 0;
  double fv = 0;
  double cu = 0;
  double cv = 0;
  int width = 0;
  int height = 0;
};

/// The grid with n x n samples per pixel of a camera's left image (or right: same intrinsics);
/// whole coordinates are the centres of pixels.
Grid sampleGrid(const StereoCamera& camera, int n);

/// A value that is linear in the grid's coordinates.
struct Linear {
  double u = 0;
  double v = 0;
  double one = 0;

  double at(double at_u, double at_v) const { return u * at_u + v * at_v + one; }
};

/// A face in a grid. With depth z: inverse_depth = 1/z, s and t = texel coordinates / z.
struct ProjectedFace {
  const Face* face = nullptr;
  int label = 0;
  float shade = 1;  ///< brightness of a white texel / 255
  std::vector<Eigen::Vector2d> outline;
  Linear inverse_depth;
  Linear s;
  Linear t;
};

/// None if the face is seen from behind or not in front of the eye. May lie outside the grid.
std::optional<ProjectedFace> project(const Face& face, const Eigen::Isometry3d& T_eye_body,
                                     const Grid& grid);

/// First and last sample of a row inside a convex outline.
struct Span {
  int first = 0;
  int last = -1;
};
Span spanOf(const std::vector<Eigen::Vector2d>& outline, int row, int width);

/// Some rows of a grid.
struct Rows {
  int first = 0;
  int count = 0;
};

/// The nearest face of every sample of some rows.
struct Visibility {
  int width = 0;
  Rows rows;
  std::vector<float> inverse_depth;  ///< [1/m], 0 = nothing
  std::vector<std::uint16_t> index;  ///< into the faces plus one, 0 = nothing
};
Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid, const Rows& rows);

/// All rows.
Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid);

}  // namespace mvo::sim
