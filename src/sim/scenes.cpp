// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// Random numbers are drawn one per statement or in braces: the order of a call's arguments is the
// compiler's choice, and a seed must mean the same scene everywhere.
#include "sim/scenes.hpp"

#include <cmath>

#include "sim/motions.hpp"
#include "sim/paintings.hpp"
#include "sim/scene_parts.hpp"

namespace mvo::sim {

Scene blocksScene(Scene scene) {
  furnish(scene, 5.2, 0);
  scene.T_world_camera = walkingCamera(scene, 1);
  Random random = randomOf(scene, kLayout);
  const auto around = [&](double value) { return value + random.uniform(-0.06, 0.06); };
  const auto scaled = [&](double value) { return value * random.uniform(0.88, 1.12); };
  const auto hang = [&](double x, double y, double z) {
    Pendulum swing;
    swing.pivot = {around(x), around(y), kCeiling - 0.02};
    swing.length = swing.pivot.z() - around(z);
    swing.phase = {random.uniform(0, 2 * M_PI), random.uniform(0, 2 * M_PI)};
    swing.yaw.start = random.uniform(-0.3, 0.3);
    return swing;
  };
  // Top left: swings sideways.
  Pendulum swing = hang(3.2, 0.62, 2.2);
  swing.tilt = {scaled(11.5) * kDegree, scaled(3.5) * kDegree};
  swing.yaw = wobble(6 * kDegree, scaled(0.22), random);
  scene.bodies.push_back(hangingBlock(scene, 0.5, swing));
  // Top right: swings and turns.
  swing = hang(3.45, -0.6, 2.13);
  swing.tilt = {scaled(7) * kDegree, scaled(8) * kDegree};
  swing.yaw.rate = random.eitherSign(scaled(36) * kDegree);
  swing.yaw.amplitude = 14 * kDegree;
  swing.yaw.frequency = scaled(0.2);
  scene.bodies.push_back(hangingBlock(scene, 0.5, swing));
  // Bottom left: swings towards the camera and back, and leaves the image now and then.
  swing = hang(2.56, 1.03, 1.1);
  swing.tilt = {scaled(4) * kDegree, scaled(7.5) * kDegree};
  swing.yaw = wobble(8 * kDegree, scaled(0.18), random);
  scene.bodies.push_back(hangingBlock(scene, 0.5, swing));
  // Bottom right: turns.
  swing = hang(2.78, -0.82, 1.05);
  swing.tilt = {0.35 * kDegree, 0.35 * kDegree};
  swing.yaw.rate = random.eitherSign(scaled(33) * kDegree);
  swing.yaw.amplitude = 12 * kDegree;
  swing.yaw.frequency = scaled(0.12);
  scene.bodies.push_back(hangingBlock(scene, 0.5, swing));
  return scene;
}

Scene spinScene(Scene scene) {
  furnish(scene, 3.6, 0);
  Handheld hand;
  hand.position = {0, 0, 1.5};
  hand.sway = {0.06, 0.05, 0.04};
  hand.turn = Eigen::Vector3d(1.0, 1.0, 1.5) * kDegree;
  scene.T_world_camera = handheld(hand, randomOf(scene, kCamera));
  Random random = randomOf(scene, kLayout);
  const Eigen::Vector3d center{random.uniform(1.85, 2.05), random.uniform(-0.05, 0.05),
                               1.5 + random.uniform(-0.05, 0.05)};
  const auto board = textureOf(checkerboard({1024, 1024}, 8, 6, randomOf(scene, kSurface)));
  const Painter edge = plainPainter(60);
  Body body;
  // Face 3 of a box looks along -x, towards the camera.
  body.faces = box({0.03, 1.05, 0.80}, [&](int face, double width, double height) {
    return face == 3 ? Paint{board, {0.95F, 1.01F, 1.0F}} : edge(face, width, height);
  });
  const double start = random.uniform(0, 2 * M_PI);
  const double rate = random.eitherSign(random.uniform(22, 28) * kDegree);
  body.T_world_body = [=](double t) {
    Eigen::Isometry3d T = at(center);
    T.rotate(Eigen::AngleAxisd(start + rate * t, Eigen::Vector3d::UnitX()));
    return T;
  };
  scene.bodies.push_back(body);
  // The stand behind it.
  append(scene.room, moved(at({center.x() + 0.12, center.y(), center.z() / 2}),
                           box({0.08, 0.08, center.z()}, woodPainter(Random(random.next())))));
  return scene;
}

Scene staticScene(Scene scene) {
  furnish(scene, 5.2, 4);
  scene.T_world_camera = walkingCamera(scene, 1);
  Random random = randomOf(scene, kLayout);
  for (const double side : {-1.0, 1.0}) {
    const Eigen::Vector3d size(0.45, 0.5, random.uniform(0.6, 1.0));
    const Eigen::Vector3d place{random.uniform(2.6, 3.4), side * random.uniform(0.6, 1.1),
                                size.z() / 2};
    const double yaw = random.uniform(-0.7, 0.7);
    append(scene.room,
           moved(at(place, yaw), box(size, collagePainter({20, 230}, Random(random.next())))));
  }
  return scene;
}

Scene occlusionScene(Scene scene) {
  furnish(scene, 5.6, 0);
  scene.T_world_camera = walkingCamera(scene, 0.6);
  Random random = randomOf(scene, kLayout);
  const Eigen::Vector2d place(2.5, random.uniform(0.0, 0.15));
  const double pillar_yaw = random.uniform(0.2, 0.5);
  addPillar(scene, place, 0.62, pillar_yaw, woodPainter(Random(random.next())));
  // The box hangs on a rail and slides behind the pillar.
  Body slider;
  slider.faces =
      box(Eigen::Vector3d::Constant(0.56), collagePainter({10, 245}, randomOf(scene, kSurface)));
  addString(slider, 0.28, 2.6);
  Wave along{0, 0, 1.55, random.uniform(0.072, 0.085), random.uniform(1.2, 2.0)};
  const Wave across{random.uniform(3.85, 4.0), 0, 0.1, 0.11, random.uniform(0, 6)};
  const Wave up{1.55, 0, 0.04, 0.14, random.uniform(0, 6)};
  Wave sway = wobble(20 * kDegree, 0.07, random);
  sway.start = random.eitherSign(25 * kDegree);
  slider.T_world_body = wandering({across, along, up}, sway);
  scene.bodies.push_back(slider);
  // The prism turns on the spot.
  Body hexagon;
  const double half = 0.27 * std::sqrt(0.75);
  const std::vector<Eigen::Vector2d> base = {{0.27, 0},  {0.135, half},   {-0.135, half},
                                             {-0.27, 0}, {-0.135, -half}, {0.135, -half}};
  hexagon.faces = prism(base, 0.46, collagePainter({10, 245}, randomOf(scene, kSurface + 1)));
  addString(hexagon, 0.23, 2.7);
  const Wave x{2.62, 0, 0.09, 0.2, random.uniform(0, 6)};
  const Wave y{-0.96, 0, 0.09, 0.2, random.uniform(0, 6)};
  const Wave turning{0, random.eitherSign(random.uniform(26, 32) * kDegree), 0.15, 0.15, 0};
  hexagon.T_world_body = wandering({x, y, Wave{0.8, 0, 0, 0, 0}}, turning);
  scene.bodies.push_back(hexagon);
  return scene;
}

Scene carsScene(Scene scene) {
  furnish(scene, 5.6, 60);
  Handheld hand;
  hand.position = {-0.12, -0.02, 1.58};
  hand.sway = {0.15, 0.45, 0.1};
  hand.pitch = 24 * kDegree;
  hand.turn = Eigen::Vector3d(3.5, 2.5, 4.5) * kDegree;
  scene.T_world_camera = handheld(hand, randomOf(scene, kCamera));
  Random random = randomOf(scene, kLayout);
  const auto around = [&](double value) { return value + random.uniform(-0.05, 0.05); };
  const auto car = [&](double length, Drive drive) {
    const CarShape shape{length, 0.52 * length, 0.32 * length, 0.28 * length, 0.48 * length};
    drive.center.z() = 0.04 + shape.chassis / 2;
    Body body;
    body.faces = carFaces(
        shape, collagePainter({10, 245}, randomOf(scene, kSurface + static_cast<std::uint64_t>(
                                                                        scene.bodies.size()))));
    body.T_world_body = driving(drive);
    scene.bodies.push_back(body);
  };
  const auto drive = [&](double x, double y, double a, double b, double speed) {
    Drive plan;
    plan.center = {around(x), around(y), 0};
    plan.radii = {around(a), around(b)};
    plan.speed = speed * random.uniform(0.9, 1.1);
    plan.start = random.uniform(0, 2 * M_PI);
    plan.go = random.uniform(4.5, 7.0);
    plan.rest = random.uniform(2.0, 3.5);
    plan.delay = -random.uniform(0, 7);
    return plan;
  };
  car(0.62, drive(2.6, 0.95, 0.42, 0.42, 0.36));
  car(0.58, drive(2.35, -0.75, 0.38, 0.42, -0.30));
  car(0.80, drive(3.85, -0.35, 0.38, 0.65, 0.36));
  return scene;
}

}  // namespace mvo::sim
