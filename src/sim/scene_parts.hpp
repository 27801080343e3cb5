// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What several scenes are made of: paint, furniture, hanging blocks, cars, a walking camera.
#pragma once

#include <cmath>

#include "sim/motions.hpp"
#include "sim/paintings.hpp"
#include "sim/random.hpp"
#include "sim/shapes.hpp"

namespace mvo::sim {

inline constexpr double kDegree = M_PI / 180;  ///< [rad]
inline constexpr double kCeiling = 3.5;        ///< of the furnished room [m]

/// What the seed's streams of random numbers are for; the body's number is added.
enum Stream : std::uint64_t { kRoom = 100, kCamera = 200, kLayout = 300, kSurface = 1000 };

Random randomOf(const Scene& scene, std::uint64_t stream);

std::shared_ptr<const Texture> textureOf(const cv::Mat& bitmap);

/// Every face a collage of its own, about two texels per pixel of a usual image at two metres.
Painter collagePainter(const Tones& tones, Random random);
Painter woodPainter(Random random);
Painter plainPainter(double grey);

/// A pose of a position [m] and a turn about the vertical [rad].
Eigen::Isometry3d at(const Eigen::Vector3d& position, double yaw = 0);

void append(std::vector<Face>& faces, const std::vector<Face>& more);

/// A post from the floor to the furnished room's ceiling.
void addPillar(Scene& scene, const Eigen::Vector2d& place, double width, double yaw,
               const Painter& painter);

/// Sizes of a car [m].
struct CarShape {
  double length = 0;
  double width = 0;
  double chassis = 0;  ///< height of the lower box
  double cabin = 0;    ///< height of the cabin on it
  double cabin_width = 0;
};

/// Chassis around the origin, x forward, and cabin.
std::vector<Face> carFaces(const CarShape& shape, const Painter& painter);

/// Makes a room with its far wall at x = depth, with some boxes and posts along the walls and that
/// many pictures on the floor.
void furnish(Scene& scene, double depth, int mats);

/// A sine of a random phase.
Wave wobble(double amplitude, double frequency, Random& random);

/// A body's parts may hang on a string that moves with it, from `top` above its centre to `end`.
void addString(Body& body, double top, double end);

/// A cube that swings, painted as the scene's next body.
Body hangingBlock(Scene& scene, double side, const Pendulum& swing);

/// In the hands of somebody who stands in the furnished room; `amount` scales how much he sways.
Motion walkingCamera(const Scene& scene, double amount);

}  // namespace mvo::sim
