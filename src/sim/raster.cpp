// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mvo::sim {
namespace {

constexpr double kNear = 0.05;     // [m]
constexpr double kOverlap = 1e-6;  // of adjacent faces, so that no sample falls between [samples]

// The part of a polygon in front of the near plane (Sutherland and Hodgman).
std::vector<Eigen::Vector3d> clipNear(const std::vector<Eigen::Vector3d>& corners) {
  std::vector<Eigen::Vector3d> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % corners.size()];
    if (a.z() >= kNear) kept.push_back(a);
    if ((a.z() >= kNear) != (b.z() >= kNear)) {
      kept.push_back(a + (b - a) * (kNear - a.z()) / (b.z() - a.z()));
    }
  }
  return kept;
}

// weight . ray + offset in grid coordinates, ray = ((u - cu) / fu, (v - cv) / fv, 1).
Linear alongRay(const Eigen::Vector3d& weight, const Grid& grid) {
  const double u = weight.x() / grid.fu;
  const double v = weight.y() / grid.fv;
  return {u, v, weight.z() - u * grid.cu - v * grid.cv};
}

}  // namespace

Grid sampleGrid(const StereoCamera& camera, int n) {
  return {
      camera.fu * n,    camera.fv * n,    (camera.cu + 0.5) * n - 0.5, (camera.cv + 0.5) * n - 0.5,
      camera.width * n, camera.height * n};
}

std::optional<ProjectedFace> project(const Face& face, const Eigen::Isometry3d& T_eye_body,
                                     const Grid& grid) {
  const Eigen::Vector3d normal = T_eye_body.linear() * face.normal;
  const double distance = normal.dot(T_eye_body * face.corners.front());
  if (distance >= -1e-6) return std::nullopt;
  std::vector<Eigen::Vector3d> corners;
  for (const Eigen::Vector3d& corner : face.corners) corners.push_back(T_eye_body * corner);
  corners = clipNear(corners);
  if (corners.size() < 3) return std::nullopt;

  ProjectedFace projected;
  projected.face = &face;
  for (const Eigen::Vector3d& p : corners) {
    projected.outline.emplace_back(grid.fu * p.x() / p.z() + grid.cu,
                                   grid.fv * p.y() / p.z() + grid.cv);
  }
  // On the plane normal . p = distance with p = z ray: 1/z = normal . ray / distance.
  const Eigen::Vector3d inverse_depth = normal / distance;
  projected.inverse_depth = alongRay(inverse_depth, grid);
  // s = axis . p + offset, so s/z = axis . ray + offset / z.
  const auto over_depth = [&](const Eigen::Vector3d& axis_body, double offset_body) {
    const Eigen::Vector3d axis = T_eye_body.linear() * axis_body;
    const double offset = offset_body - axis.dot(T_eye_body.translation());
    return alongRay(axis + offset * inverse_depth, grid);
  };
  projected.s = over_depth(face.s_axis, face.s_offset);
  projected.t = over_depth(face.t_axis, face.t_offset);
  return projected;
}

Span spanOf(const std::vector<Eigen::Vector2d>& outline, int row, int width) {
  double low = std::numeric_limits<double>::max();
  double high = -low;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& a = outline[i];
    const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
    if ((a.y() < row) == (b.y() < row)) continue;
    const double u = a.x() + (b.x() - a.x()) * (row - a.y()) / (b.y() - a.y());
    low = std::min(low, u);
    high = std::max(high, u);
  }
  if (low > high) return {};
  low = std::max(std::ceil(low - kOverlap), 0.0);
  high = std::min(std::floor(high + kOverlap), width - 1.0);
  if (low > high) return {};
  return {static_cast<int>(low), static_cast<int>(high)};
}

Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid) {
  return visibility(faces, grid, {0, grid.height});
}

Visibility visibility(const std::vector<ProjectedFace>& faces, const Grid& grid, const Rows& rows) {
  Visibility seen;
  seen.width = grid.width;
  seen.rows = rows;
  const std::size_t samples = static_cast<std::size_t>(grid.width) * rows.count;
  seen.inverse_depth.assign(samples, 0.0F);
  seen.index.assign(samples, 0);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const ProjectedFace& face = faces[f];
    const auto [top, bottom] =
        std::minmax_element(face.outline.begin(), face.outline.end(),
                            [](const auto& a, const auto& b) { return a.y() < b.y(); });
    const int end = rows.first + rows.count;
    const int first_row =
        static_cast<int>(std::clamp<double>(std::ceil(top->y()), rows.first, end));
    const int last_row =
        static_cast<int>(std::clamp<double>(std::floor(bottom->y()), rows.first - 1, end - 1));
    const auto index = static_cast<std::uint16_t>(f + 1);
    const auto step = static_cast<float>(face.inverse_depth.u);
    for (int row = first_row; row <= last_row; ++row) {
      const Span span = spanOf(face.outline, row, grid.width);
      const auto start = static_cast<float>(face.inverse_depth.at(span.first, row));
      const std::size_t offset =
          static_cast<std::size_t>(row - rows.first) * grid.width + span.first;
      float* nearest = seen.inverse_depth.data() + offset;
      std::uint16_t* owner = seen.index.data() + offset;
      const int length = span.last - span.first + 1;
      for (int i = 0; i < length; ++i) {
        const float inverse_depth = start + step * static_cast<float>(i);
        const bool nearer = inverse_depth > nearest[i];
        nearest[i] = nearer ? inverse_depth : nearest[i];
        owner[i] = nearer ? index : owner[i];
      }
    }
  }
  return seen;
}

}  // namespace mvo::sim
