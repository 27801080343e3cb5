// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/shapes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim/texture.hpp"

namespace mvo::sim {

Face polygon(std::vector<Eigen::Vector3d> corners, int number, const Painter& painter) {
  Face face;
  face.normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
  const bool horizontal = std::abs(face.normal.z()) > 0.99;
  const Eigen::Vector3d up = horizontal ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d right = up.cross(face.normal).normalized();
  const Eigen::Vector3d down = right.cross(face.normal);
  double s_min = std::numeric_limits<double>::max();
  double t_min = s_min;
  double s_max = -s_min;
  double t_max = -s_min;
  for (const Eigen::Vector3d& corner : corners) {
    s_min = std::min(s_min, right.dot(corner));
    s_max = std::max(s_max, right.dot(corner));
    t_min = std::min(t_min, down.dot(corner));
    t_max = std::max(t_max, down.dot(corner));
  }
  const Paint paint = painter(number, s_max - s_min, t_max - t_min);
  face.texture = paint.texture;
  face.tint = paint.tint;
  const double s_scale = paint.texture->width() / (s_max - s_min);
  const double t_scale = paint.texture->height() / (t_max - t_min);
  face.s_axis = s_scale * right;
  face.t_axis = t_scale * down;
  face.s_offset = -s_scale * s_min;
  face.t_offset = -t_scale * t_min;
  face.corners = std::move(corners);
  return face;
}

std::vector<Face> prism(const std::vector<Eigen::Vector2d>& base, double height,
                        const Painter& painter) {
  const auto at = [&](std::size_t i, double z) {
    const Eigen::Vector2d& corner = base[i % base.size()];
    return Eigen::Vector3d(corner.x(), corner.y(), z);
  };
  const double z = height / 2;
  std::vector<Face> faces;
  std::vector<Eigen::Vector3d> top;
  std::vector<Eigen::Vector3d> bottom;
  for (std::size_t i = 0; i < base.size(); ++i) {
    faces.push_back(
        polygon({at(i, -z), at(i + 1, -z), at(i + 1, z), at(i, z)}, static_cast<int>(i), painter));
    top.push_back(at(i, z));
    bottom.push_back(at(base.size() - 1 - i, -z));
  }
  faces.push_back(polygon(std::move(top), static_cast<int>(base.size()), painter));
  faces.push_back(polygon(std::move(bottom), static_cast<int>(base.size()) + 1, painter));
  return faces;
}

std::vector<Face> box(const Eigen::Vector3d& size, const Painter& painter) {
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  return prism({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, size.z(), painter);
}

std::vector<Face> moved(const Eigen::Isometry3d& T, std::vector<Face> faces) {
  for (Face& face : faces) {
    for (Eigen::Vector3d& corner : face.corners) corner = T * corner;
    face.normal = T.linear() * face.normal;
    face.s_axis = T.linear() * face.s_axis;
    face.t_axis = T.linear() * face.t_axis;
    face.s_offset -= face.s_axis.dot(T.translation());
    face.t_offset -= face.t_axis.dot(T.translation());
  }
  return faces;
}

std::vector<Face> room(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                       const Painter& painter) {
  const auto at = [&](int x, int y, int z) {
    return Eigen::Vector3d(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  return {polygon({at(1, 1, 0), at(1, 0, 0), at(1, 0, 1), at(1, 1, 1)}, 0, painter),
          polygon({at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1)}, 1, painter),
          polygon({at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1)}, 2, painter),
          polygon({at(1, 0, 0), at(0, 0, 0), at(0, 0, 1), at(1, 0, 1)}, 3, painter),
          polygon({at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1)}, 4, painter),
          polygon({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)}, 5, painter)};
}

}  // namespace mvo::sim
