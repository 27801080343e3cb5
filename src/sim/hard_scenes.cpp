// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are hard although the camera is exact: what is near, small, many, slow or plain.
// Random numbers are drawn one per statement or in braces: the order of a call's arguments is the
// compiler's choice, and a seed must mean the same scene everywhere.
#include <cmath>

#include "sim/scene_parts.hpp"
#include "sim/scenes.hpp"

namespace mvo::sim {
namespace {

// A tall box on the floor in a painting of its own.
std::vector<Face> paintedBox(const Scene& scene, const Eigen::Vector3d& size) {
  return box(size, collagePainter({10, 245}, randomOf(scene, kSurface + scene.bodies.size())));
}

// A circle before the camera, across its view, at constant speed and without turning.
Motion circling(const Eigen::Vector3d& center, double radius, double speed, double start) {
  return [=](double t) {
    const double angle = start + speed / radius * t;
    return at(center + radius * Eigen::Vector3d(0, std::cos(angle), std::sin(angle)));
  };
}

// Plain walls, and doors, plain too, with a few notices.
void addCorridor(Scene& scene, Random& random) {
  constexpr double kHalfWidth = 1.05;  // [m]
  constexpr double kHeight = 2.6;      // [m]
  scene.room =
      room({-12, -kHalfWidth, 0}, {15, kHalfWidth, kHeight}, [&](int face, double, double) {
        const Random look(random.next());
        const double mean = face == 4 ? 150 : face == 5 ? 95 : random.uniform(118, 132);
        return Paint{textureOf(plaster({1024, 256}, mean, 2.2, look)), {1, 1, 1}};
      });
  for (const double side : {-1.0, 1.0}) {
    double x = -10;
    while (x < 14) {
      append(scene.room, moved(at({x, side * kHalfWidth, 1.02}),
                               box({0.9, 0.06, 2.04}, plainPainter(random.uniform(88, 105)))));
      if (random.integer(0, 2) == 0) {
        const Eigen::Vector3d place{x + random.uniform(0.8, 1.6), side * kHalfWidth, 1.5};
        const Painter notice = collagePainter({90, 190}, Random(random.next()));
        append(scene.room, moved(at(place), box({0.3, 0.02, 0.42}, notice)));
      }
      x += random.uniform(3.2, 4.6);
    }
  }
}

}  // namespace

Scene passingScene(Scene scene) {
  furnish(scene, 5.2, 4);
  scene.T_world_camera = walkingCamera(scene, 0.4);
  Random random = randomOf(scene, kLayout);
  // To and fro before the camera, from out of view on one side to out of view on the other.
  Body near_block;
  near_block.faces = paintedBox(scene, {0.5, 0.78, 0.74});
  addString(near_block, 0.37, 1.9);
  const double rate = random.uniform(0.055, 0.065);  // [Hz]
  const Wave across{0, 0, 1.8, rate, random.uniform(2.2, 2.8)};
  const Wave depth{random.uniform(0.98, 1.02), 0, 0.03, 0.17, random.uniform(0, 2 * M_PI)};
  const Wave up{1.57, 0, 0.02, 0.21, random.uniform(0, 2 * M_PI)};
  near_block.T_world_body =
      wandering({depth, across, up}, wobble(random.uniform(6, 9) * kDegree, 0.13, random));
  scene.bodies.push_back(near_block);
  Pendulum swing;
  swing.pivot = {random.uniform(3.2, 3.5), random.uniform(0.5, 0.8), kCeiling - 0.02};
  swing.length = 1.5;
  swing.tilt = {9 * kDegree, 4 * kDegree};
  swing.phase = {random.uniform(0, 2 * M_PI), random.uniform(0, 2 * M_PI)};
  swing.yaw = wobble(12 * kDegree, 0.2, random);
  scene.bodies.push_back(hangingBlock(scene, 0.5, swing));
  return scene;
}

Scene twelveScene(Scene scene) {
  constexpr double kPixels = 55;  // a block's size in an image of the usual width
  constexpr double kFocal = 500;  // there
  furnish(scene, 5.6, 0);
  scene.T_world_camera = walkingCamera(scene, 1);
  Random random = randomOf(scene, kLayout);
  for (int row = 0; row < 3; ++row) {
    // The strings of lower blocks pass behind the upper ones.
    const double depth = 2.7 + 0.45 * row;
    const double spacing = 0.235 * (depth + 0.1);
    for (int column = 0; column < 4; ++column) {
      const double side = kPixels / kFocal * depth / 1.2;  // 1.2: seen at an angle
      Pendulum swing;
      swing.pivot = {depth + random.uniform(-0.08, 0.08), (1.5 - column) * spacing,
                     kCeiling - 0.02};
      swing.length = kCeiling - 0.02 - (1.6 + (1 - row) * 0.24 * (depth + 0.1));
      const double reach = random.uniform(0.1, 0.14) / swing.length;  // [rad]
      const double share = random.uniform(0.4, 0.8);
      swing.tilt = {share * reach, (1 - share) * reach};
      swing.phase = {random.uniform(0, 2 * M_PI), random.uniform(0, 2 * M_PI)};
      swing.yaw.start = random.uniform(-0.5, 0.5);
      swing.yaw.rate = column % 2 == 0 ? random.eitherSign(random.uniform(15, 30) * kDegree) : 0;
      scene.bodies.push_back(hangingBlock(scene, side, swing));
    }
  }
  return scene;
}

Scene corridorScene(Scene scene) {
  constexpr double kReach = 9;  // how far the camera walks from the middle [m]
  Random random = randomOf(scene, kRoom);
  addCorridor(scene, random);
  const Wave along{0, 0, kReach, 1.0 / 60, random.uniform(-1.0, -0.6)};
  Handheld hand;
  hand.position = {0, 0, 1.5};
  hand.sway = {0.05, 0.12, 0.05};
  hand.turn = Eigen::Vector3d(2.0, 2.0, 4.0) * kDegree;
  const Motion carried = handheld(hand, randomOf(scene, kCamera));
  scene.T_world_camera = [=](double t) { return at({along.at(t), 0, 0}) * carried(t); };
  // A cart that rolls ahead.
  Body cart;
  const Eigen::Vector3d size(0.6, 0.45, 0.7);
  cart.faces = paintedBox(scene, size);
  const Wave ahead{random.uniform(2.7, 3.0), 0, 0.5, 0.07, random.uniform(0, 2 * M_PI)};
  const Wave aside = wobble(0.3, 0.11, random);
  const Wave turn = wobble(9 * kDegree, 0.12, random);
  cart.T_world_body = [=](double t) {
    return at({along.at(t) + ahead.at(t), aside.at(t), size.z() / 2}, turn.at(t));
  };
  scene.bodies.push_back(cart);
  return scene;
}

Scene slowScene(Scene scene) {
  constexpr double kFocal = 500;  // of an image of the usual width [px]
  constexpr double kRate = 15;    // the usual one [Hz]
  furnish(scene, 5.2, 0);
  scene.T_world_camera = walkingCamera(scene, 1);
  Random random = randomOf(scene, kLayout);
  const auto hang = [&](const Eigen::Vector3d& center, double side, double pixels_per_frame) {
    Body body;
    body.faces = paintedBox(scene, Eigen::Vector3d::Constant(side));
    addString(body, side / 2, kCeiling + 0.3 - center.z());
    const double speed = pixels_per_frame * (center.x() - side / 2) / kFocal * kRate;  // [m/s]
    const double start = random.uniform(0, 2 * M_PI);
    body.T_world_body = circling(center, 0.22, random.eitherSign(speed), start);
    scene.bodies.push_back(body);
  };
  const auto around = [&](double value) { return value + random.uniform(-0.06, 0.06); };
  const auto slow = [&](double x, double y, double z, double pixels) {
    const Eigen::Vector3d center{around(x), around(y), around(z)};
    hang(center, 0.5, pixels * random.uniform(0.9, 1.1));
  };
  slow(3.3, 0.95, 1.95, 0.22);
  slow(3.2, -0.85, 1.95, 0.5);
  slow(2.7, 0.1, 1.0, 0.9);
  slow(2.9, 1.2, 0.95, 0.35);
  slow(3.0, -1.05, 0.95, 0.7);
  return scene;
}

}  // namespace mvo::sim
