// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Polyhedra of textured faces.
#pragma once

#include <functional>

#include "mvo/sim.hpp"

namespace mvo::sim {

/// How a face looks.
struct Paint {
  std::shared_ptr<const Texture> texture;
  cv::Vec3f tint{1, 1, 1};
};

/// The looks of a face of a width and height [m]; asked for in order, sides first, then top,
/// bottom.
using Painter = std::function<Paint(int face, double width, double height)>;

/// A convex polygon given counter-clockwise as seen from outside. The texture covers it once, its
/// upper edge along the world's or body's up where the face is not horizontal. `number` is what the
/// painter is told.
Face polygon(std::vector<Eigen::Vector3d> corners, int number, const Painter& painter);

/// A right prism over a convex polygon (counter-clockwise in x, y), from z = -height/2 to height/2.
std::vector<Face> prism(const std::vector<Eigen::Vector2d>& base, double height,
                        const Painter& painter);

/// A box around the origin.
std::vector<Face> box(const Eigen::Vector3d& size, const Painter& painter);

/// The faces as moved by a transform.
std::vector<Face> moved(const Eigen::Isometry3d& T, std::vector<Face> faces);

/// The room between two corners, seen from inside; faces: x max, y max, x min, y min, ceiling,
/// floor.
std::vector<Face> room(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       const Painter& painter);

}  // namespace mvo::sim
