// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// A room with two people, whose limbs swing, and a cart.
#include <cmath>

#include "sim/scene_parts.hpp"
#include "sim/scenes.hpp"

namespace mvo::sim {
namespace {

constexpr double kHip = 0.9;     // above the floor [m]
constexpr double kThigh = 0.44;  // [m]
constexpr double kArm = 0.62;    // [m]

// A person's swing: an angle that follows the way walked, so that nobody walks on the spot.
struct Gait {
  Drive walk;
  double amplitude = 0;  // [rad]

  double phase(double t) const {
    constexpr double kStride = 1.3;  // two steps [m]
    return 2 * M_PI / kStride * std::abs(walk.speed) * driven(walk, t);
  }
};

Eigen::Isometry3d hinge(const Eigen::Vector3d& place, double angle) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(place);
  T.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()));
  return T;
}

// A box that hangs down from a joint.
std::vector<Face> hanging(const Eigen::Vector3d& size, const Painter& painter) {
  return moved(at({0, 0, -size.z() / 2}), box(size, painter));
}

// `side` is 1 for the left limbs, -1 for the right ones.
void addSide(Body& body, const Gait& gait, double side, const Painter& trousers,
             const Painter& sleeve) {
  const Eigen::Vector3d hip(0, 0.1 * side, 0);
  const auto swing = [=](double t) { return side * gait.amplitude * std::sin(gait.phase(t)); };
  // The knee bends while the leg comes forward.
  const auto bend = [=](double t) {
    return 1.6 * gait.amplitude * std::max(0.0, side * std::cos(gait.phase(t)));
  };
  body.limbs.push_back(
      {hanging({0.17, 0.17, kThigh}, trousers), [=](double t) { return hinge(hip, -swing(t)); }});
  body.limbs.push_back({hanging({0.14, 0.14, kHip - kThigh}, trousers), [=](double t) {
                          return hinge(hip, -swing(t)) * hinge({0, 0, -kThigh}, bend(t));
                        }});
  const Eigen::Vector3d shoulder(0, 0.29 * side, 0.56);
  body.limbs.push_back({hanging({0.11, 0.11, kArm}, sleeve),
                        [=](double t) { return hinge(shoulder, 0.8 * swing(t)); }});
}

// Origin between the hips, x forward.
Body person(const Scene& scene, const Drive& walk) {
  Random look = randomOf(scene, kSurface + scene.bodies.size());
  const Painter shirt = collagePainter({30, 225}, Random(look.next()));
  const Painter trousers = collagePainter({20, 150}, Random(look.next()));
  const Painter head = collagePainter({70, 210}, Random(look.next()));
  Body body;
  body.faces = moved(at({0, 0, 0.3}), box({0.25, 0.42, 0.6}, shirt));
  append(body.faces, moved(at({0, 0, 0.75}), box({0.2, 0.18, 0.25}, head)));
  const Gait gait{walk, look.uniform(24, 30) * kDegree};
  for (const double side : {1.0, -1.0}) addSide(body, gait, side, trousers, shirt);
  const Motion carried = driving(walk);
  body.T_world_body = [=](double t) {
    // Legs apart, the hips are lower.
    const double fall = kHip * (1 - std::cos(gait.amplitude * std::sin(gait.phase(t))));
    return Eigen::Translation3d(0, 0, -fall) * carried(t);
  };
  return body;
}

}  // namespace

Scene peopleScene(Scene scene) {
  furnish(scene, 5.6, 20);
  scene.T_world_camera = walkingCamera(scene, 0.5);
  Random random = randomOf(scene, kLayout);
  const auto around = [&](double value) { return value + random.uniform(-0.06, 0.06); };
  const auto path = [&](const Eigen::Vector3d& center, const Eigen::Vector2d& radii, double speed) {
    Drive drive;
    drive.center = {around(center.x()), around(center.y()), center.z()};
    drive.radii = {around(radii.x()), around(radii.y())};
    drive.speed = speed * random.uniform(0.92, 1.08);
    drive.start = random.uniform(0, 2 * M_PI);
    drive.go = random.uniform(7, 9);
    drive.rest = random.uniform(0.8, 1.4);
    drive.delay = -random.uniform(0, 5);
    return drive;
  };
  Body cart;
  const Eigen::Vector3d size(0.62, 0.46, 0.6);
  cart.faces = box(size, collagePainter({10, 245}, randomOf(scene, kSurface)));
  cart.T_world_body = driving(path({2.75, 0.0, 0.05 + size.z() / 2}, {0.3, 0.45}, 0.32));
  scene.bodies.push_back(cart);
  // One on the left, one on the right, around places of their own.
  scene.bodies.push_back(person(scene, path({3.2, 1.2, kHip}, {0.55, 0.4}, 0.75)));
  scene.bodies.push_back(person(scene, path({3.3, -1.2, kHip}, {0.6, 0.42}, -0.85)));
  return scene;
}

}  // namespace mvo::sim
