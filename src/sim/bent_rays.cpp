// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/bent_rays.hpp"

#include <algorithm>

namespace mvo::sim {
namespace {

constexpr double kOverlap = 1e-6;  // of adjacent faces, so that no sample falls between [samples]

// The half planes whose intersection is a convex polygon, and its bounds.
struct Inside {
  std::vector<Linear> distances;  // to each edge's line, positive inside [samples]
  Eigen::AlignedBox2d bounds;

  bool contains(const Eigen::Vector2d& point) const {
    return std::all_of(distances.begin(), distances.end(), [&](const Linear& distance) {
      return distance.at(point.x(), point.y()) >= -kOverlap;
    });
  }
};

Inside insideOf(const std::vector<Eigen::Vector2d>& outline) {
  Inside inside;
  double twice_area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    twice_area += a.x() * b.y() - a.y() * b.x();
    inside.bounds.extend(a);
  }
  const double side = twice_area < 0 ? -1 : 1;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - a;
    const double length = edge.norm();
    if (length == 0) continue;
    const Eigen::Vector2d normal = side / length * Eigen::Vector2d(-edge.y(), edge.x());
    inside.distances.push_back({normal.x(), normal.y(), -normal.dot(a)});
  }
  return inside;
}

}  // namespace

BentRays bentRays(const Eye& eye, int n, const Rows& rows) {
  const int width = eye.lens.width * n;
  BentRays rays;
  rays.rows = rows;
  rays.points.reserve(static_cast<std::size_t>(width) * rows.count);
  const Eigen::Vector2d half(0.5, 0.5);
  for (int row = rows.first; row < rows.first + rows.count; ++row) {
    for (int column = 0; column < width; ++column) {
      const Eigen::Vector2d pixel = (Eigen::Vector2d(column, row) + half) / n - half;
      rays.points.emplace_back((eye.undistort(pixel) + half) * n - half);
    }
  }
  return rays;
}

Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid,
                      const BentRays& rays) {
  Visibility seen;
  seen.width = grid.width;
  seen.rows = rays.rows;
  seen.inverse_depth.assign(rays.points.size(), 0.0F);
  seen.index.assign(rays.points.size(), 0);
  Eigen::AlignedBox2d looked_at;
  for (const Eigen::Vector2d& point : rays.points) looked_at.extend(point);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Inside inside = insideOf(faces[f].outline);
    if (!inside.bounds.intersects(looked_at)) continue;
    for (std::size_t i = 0; i < rays.points.size(); ++i) {
      const Eigen::Vector2d& point = rays.points[i];
      if (!inside.contains(point)) continue;
      const auto inverse_depth =
          static_cast<float>(faces[f].inverse_depth.at(point.x(), point.y()));
      if (!(inverse_depth > seen.inverse_depth[i])) continue;
      seen.inverse_depth[i] = inverse_depth;
      seen.index[i] = static_cast<std::uint16_t>(f + 1);
    }
  }
  return seen;
}

}  // namespace mvo::sim
