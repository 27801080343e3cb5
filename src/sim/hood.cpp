// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/hood.hpp"

#include "sim/scene_parts.hpp"

namespace mvo::sim {

std::vector<Face> hoodFaces(const Scene& scene, double share) {
  constexpr double kFar = 1.2;                // depth of the far edge [m]
  constexpr double kClose = 0.7;              // of the near one, below the image [m]
  constexpr double kSpread = 1.5;             // wider than the image by this share on each side
  constexpr std::uint64_t kHoodStream = 500;  // beside those of scenes
  if (share <= 0) return {};
  const StereoCamera& camera = scene.camera;
  // Row r is the pixel whose middle is at r: the edge lies between two rows.
  const auto corner = [&](double side, double row, double depth) {
    return Eigen::Vector3d(side * kSpread * camera.width / camera.fu * depth,
                           (row - camera.cv) / camera.fv * depth, depth);
  };
  const double edge = camera.height * (1 - share) - 0.5;
  const double below = 1.3 * camera.height;
  const Painter painter = collagePainter({25, 120}, randomOf(scene, kHoodStream));
  return {polygon({corner(-1, edge, kFar), corner(-1, below, kClose), corner(1, below, kClose),
                   corner(1, edge, kFar)},
                  0, painter)};
}

}  // namespace mvo::sim
