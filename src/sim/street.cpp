// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// A street with bends as a car's camera sees it: houses, trees, parked cars, a crossing, traffic.
#include <cmath>

#include "sim/circuit.hpp"
#include "sim/scene_parts.hpp"
#include "sim/scenes.hpp"

namespace mvo::sim {
namespace {

constexpr double kLane = 1.8;     // from the centre line to the middle of a lane [m]
constexpr double kKerb = 5.2;     // from the centre line to parked cars [m]
constexpr double kCrossing = 62;  // where the crossing is, along the circuit [m]
constexpr double kHalfGap = 6;    // half of the gap between the houses there [m]
constexpr double kLand = 400;     // half of the land's side [m]
constexpr CarShape kCar{4.3, 1.8, 0.85, 0.62, 1.6};
constexpr double kCarHeight = 0.25 + kCar.chassis / 2;  // of its origin above the ground

// A pose beside the street, x along it.
Eigen::Isometry3d beside(const Circuit& circuit, double way, double left, double up) {
  return Eigen::Translation3d(0, 0, up) * circuit.pose(way, left);
}

bool isAtCrossing(double way, double half_length) {
  return std::abs(way - kCrossing) < kHalfGap + half_length;
}

// Repeats a face's texture so many times along each side.
void repeat(Face& face, double times) {
  face.s_axis *= times;
  face.t_axis *= times;
  face.s_offset *= times;
  face.t_offset *= times;
}

void addLandAndSky(Scene& scene, Random& random) {
  constexpr double kTile = 14;  // a texture's side on the ground [m]
  std::vector<Face> land =
      room({-kLand, -kLand, 0}, {kLand, kLand, 120}, [&](int face, double, double) {
        const Random look(random.next());
        if (face == 5) return Paint{textureOf(ground({2048, 2048}, 26, 0, look)), {1, 1, 1}};
        return Paint{textureOf(plaster({512, 512}, 185, 22, look)), {1.05F, 1, 0.95F}};
      });
  repeat(land.back(), std::round(2 * kLand / kTile));
  append(scene.room, land);
}

// Houses on both sides; their walls are few pictures in many tints.
void addHouses(Scene& scene, const Circuit& circuit, Random& random) {
  std::vector<std::shared_ptr<const Texture>> walls;
  for (int i = 0; i < 8; ++i) {
    const int brick = random.integer(30, 52);
    walls.push_back(textureOf(wall({1024, 512}, brick, 110, Random(random.next()))));
  }
  const Painter painter = [&](int, double, double) {
    const auto& texture = walls[random.integer(0, static_cast<int>(walls.size()) - 1)];
    const auto blue = static_cast<float>(random.uniform(0.85, 1.15));
    return Paint{texture, {blue, 1, 2 - blue}};
  };
  for (const double side : {-1.0, 1.0}) {
    double way = 0;
    while (way < circuit.length() - 16) {
      const Eigen::Vector3d size{random.uniform(9, 15), random.uniform(7, 9),
                                 random.uniform(5, 11)};
      const double left = side * (random.uniform(9.5, 12.5) + size.y() / 2);
      const double middle = way + size.x() / 2;
      if (!isAtCrossing(middle, size.x() / 2))
        append(scene.room, moved(beside(circuit, middle, left, size.z() / 2), box(size, painter)));
      // On the inner side of a bend a front is shorter than the way along the centre line.
      way += size.x() * random.uniform(1.05, 1.25);
    }
  }
}

// Lamps, trees and parked cars along the kerbs.
void addKerbs(Scene& scene, const Circuit& circuit, Random& random) {
  constexpr int kNothing = -1;
  std::vector<std::vector<Face>> cars;
  cars.reserve(5);
  for (int i = 0; i < 5; ++i)
    cars.push_back(carFaces(kCar, collagePainter({20, 200}, Random(random.next()))));
  const Painter bark = woodPainter(Random(random.next()));
  const std::vector<Face> trunk = box({0.3, 0.3, 3}, bark);
  const std::vector<Face> crown =
      box({2.2, 2.2, 2.4}, collagePainter({30, 150}, Random(random.next())));
  const std::vector<Face> lamp = box({0.14, 0.14, 6}, plainPainter(70));
  for (const double side : {-1.0, 1.0}) {
    double way = 2;
    while (way < circuit.length() - 6) {
      const int drawn = random.integer(0, 3);
      const int what = isAtCrossing(way, 3) ? kNothing : drawn;
      const double yaw = random.uniform(-0.03, 0.03);
      const auto put = [&](double left, double up, const std::vector<Face>& faces) {
        append(scene.room,
               moved(beside(circuit, way, side * left, up) * at({0, 0, 0}, yaw), faces));
      };
      if (what == 0 || what == 1) {
        put(kKerb, kCarHeight, cars[random.integer(0, static_cast<int>(cars.size()) - 1)]);
      } else if (what == 2) {
        put(kKerb + 2.2, 1.5, trunk);
        put(kKerb + 2.2, 4.2, crown);
      } else if (what == 3) {
        put(kKerb + 1.6, 3, lamp);
      }
      way += random.uniform(5, 9);
    }
  }
}

// A vehicle in a lane, turned by an angle against the circuit.
Motion along(const Circuit& circuit, const Wave& way, double left, double turn) {
  return [=](double t) {
    return beside(circuit, way.at(t), left, kCarHeight) * at({0, 0, 0}, turn);
  };
}

void addTraffic(Scene& scene, const Circuit& circuit, const Wave& ego, Random& random) {
  const auto add = [&](const Motion& motion) {
    Body car;
    car.faces =
        carFaces(kCar, collagePainter({10, 245}, randomOf(scene, kSurface + scene.bodies.size())));
    car.T_world_body = motion;
    scene.bodies.push_back(car);
  };
  // One ahead that comes nearer and falls back.
  Wave ahead = ego;
  ahead.start += random.uniform(14, 16);
  ahead.amplitude = random.uniform(3.5, 4.5);
  ahead.frequency = random.uniform(0.05, 0.08);
  ahead.phase = random.uniform(0, 2 * M_PI);
  add(along(circuit, ahead, -kLane, 0));
  // Three that come towards the camera, one after the other, in every lap.
  for (const double place : {23, 36, 69}) {
    const double meeting = place + random.uniform(-2, 2);  // [m]
    const double speed = random.uniform(6, 9);
    add(along(circuit, Wave{meeting * (1 + speed / ego.rate), -speed, 0, 0, 0}, kLane, M_PI));
  }
  // One that crosses before the camera. Between two crossings it is behind the houses.
  const Eigen::Isometry3d T_world_crossing =
      circuit.pose(kCrossing, 0) * at({0, 0, kCarHeight}, M_PI / 2);
  const double speed = random.uniform(7, 8);
  const double when = (kCrossing - random.uniform(22, 26) - ego.start) / ego.rate;
  add([=](double t) {
    constexpr double kReach = 45;  // [m]
    const double way = speed * (t - when);
    const double passes = std::floor((way + kReach) / (2 * kReach));
    return T_world_crossing * at({way - passes * 2 * kReach, 0, 0});
  });
}

}  // namespace

Scene streetScene(Scene scene) {
  constexpr double kCameraHeight = 1.65;  // [m]
  Random layout = randomOf(scene, kLayout);
  const Circuit circuit(95, {{2, layout.uniform(0.06, 0.1), layout.uniform(0, 2 * M_PI)},
                             {5, layout.uniform(0.025, 0.035), layout.uniform(0, 2 * M_PI)}});
  Random random = randomOf(scene, kRoom);
  addLandAndSky(scene, random);
  addHouses(scene, circuit, random);
  addKerbs(scene, circuit, random);
  Wave ego{0, layout.uniform(9, 10.5), 0.8, 0.05, layout.uniform(0, 2 * M_PI)};
  Random camera = randomOf(scene, kCamera);
  const Wave up = wobble(0.015, 1.1, camera);
  const Wave aside = wobble(0.15, 0.09, camera);
  const Wave yaw = wobble(0.5 * kDegree, 0.16, camera);
  const Wave pitch = wobble(0.25 * kDegree, 0.9, camera);
  const Wave roll = wobble(0.25 * kDegree, 0.6, camera);
  scene.T_world_camera = [=](double t) {
    Eigen::Isometry3d T =
        beside(circuit, ego.at(t), -kLane + aside.at(t), kCameraHeight + up.at(t)) *
        at({0, 0, 0}, yaw.at(t));
    T.rotate(Eigen::AngleAxisd(pitch.at(t), Eigen::Vector3d::UnitY()));
    T.rotate(Eigen::AngleAxisd(roll.at(t), Eigen::Vector3d::UnitX()));
    T.linear() = T.linear() * forwardLooking();
    return T;
  };
  addTraffic(scene, circuit, ego, layout);
  return scene;
}

}  // namespace mvo::sim
