// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
// Random numbers are drawn one per statement or in braces: the order of a call's arguments is the
// compiler's choice, and a seed must mean the same scene everywhere.
#include "sim/scene_parts.hpp"

#include <cmath>

#include "sim/paintings.hpp"
#include "sim/texture.hpp"

namespace mvo::sim {
namespace {

// Slightly coloured paint of the same luminance as grey.
cv::Vec3f tintOf(double strength, Random& random) {
  const double blue = random.uniform(1 - strength, 1 + strength);
  const double green = random.uniform(1 - strength / 2, 1 + strength / 2);
  const double red = random.uniform(1 - strength, 1 + strength);
  const double luminance = 0.114 * blue + 0.587 * green + 0.299 * red;
  return cv::Vec3f(static_cast<float>(blue / luminance), static_cast<float>(green / luminance),
                   static_cast<float>(red / luminance));
}

// Texels along a side: about two per pixel of a usual image at two metres.
int texelsFor(double side) {
  constexpr double kTexelsPerMetre = 700;
  int texels = 32;
  while (texels < kTexelsPerMetre * side && texels < 1024) texels *= 2;
  return texels;
}

}  // namespace

Random randomOf(const Scene& scene, std::uint64_t stream) { return Random({scene.seed, stream}); }

std::shared_ptr<const Texture> textureOf(const cv::Mat& bitmap) {
  return std::make_shared<const Texture>(makeTexture(bitmap));
}

Painter collagePainter(const Tones& tones, Random random) {
  return [=](int, double width, double height) mutable {
    const cv::Vec3f tint = tintOf(0.45, random);
    const cv::Size size(texelsFor(width), texelsFor(height));
    return Paint{textureOf(collage(size, tones, Random(random.next()))), tint};
  };
}

Painter woodPainter(Random random) {
  return [=](int, double, double) mutable {
    return Paint{textureOf(wood({256, 1024}, Random(random.next()))), {0.6F, 1.0F, 1.15F}};
  };
}

Painter plainPainter(double grey) {
  const auto texture = textureOf(cv::Mat(4, 4, CV_8UC1, cv::Scalar(grey)));
  return [=](int, double, double) { return Paint{texture, {1, 1, 1}}; };
}

Eigen::Isometry3d at(const Eigen::Vector3d& position, double yaw) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.translate(position);
  T.rotate(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  return T;
}

void append(std::vector<Face>& faces, const std::vector<Face>& more) {
  faces.insert(faces.end(), more.begin(), more.end());
}

void addPillar(Scene& scene, const Eigen::Vector2d& place, double width, double yaw,
               const Painter& painter) {
  append(scene.room, moved(at({place.x(), place.y(), kCeiling / 2}, yaw),
                           box({width, width, kCeiling}, painter)));
}

std::vector<Face> carFaces(const CarShape& shape, const Painter& painter) {
  const auto& [length, width, chassis, cabin, cabin_width] = shape;
  std::vector<Face> faces = box({length, width, chassis}, painter);
  // The cabin: a trapezoid in side view, laid on its side and put on the chassis.
  Eigen::Isometry3d T_car_cabin = at({-0.06 * length, 0, chassis / 2});
  T_car_cabin.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  append(faces, moved(T_car_cabin, prism({{-0.30 * length, 0},
                                          {0.30 * length, 0},
                                          {0.18 * length, cabin},
                                          {-0.24 * length, cabin}},
                                         cabin_width, painter)));
  return faces;
}

void furnish(Scene& scene, double depth, int mats) {
  Random random = randomOf(scene, kRoom);
  scene.room = room({-2.5, -3.6, 0}, {depth, 3.6, kCeiling}, [&](int face, double, double) {
    const Random look(random.next());
    const cv::Vec3f tint = tintOf(0.12, random);
    if (face == 2) return plainPainter(110)(face, 0, 0);  // behind the camera
    if (face == 4) return Paint{textureOf(panels({1024, 1024}, 128, look)), tint};
    if (face == 5) return Paint{textureOf(ground({2048, 2048}, 40, mats, look)), tint};
    if (face == 0) return Paint{textureOf(wall({2048, 1024}, 84, 190, look)), tint};
    return Paint{textureOf(wall({1024, 512}, 42, 95, look)), tint};  // only seen from the side
  });
  for (const double side : {-1.0, 1.0}) {
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector3d size{random.uniform(0.35, 0.6), random.uniform(0.35, 0.7),
                                 random.uniform(0.35, 1.1)};
      const Eigen::Vector3d place(depth - 0.7 - 1.3 * i, side * random.uniform(2.1, 2.8),
                                  size.z() / 2);
      const double yaw = random.uniform(-0.6, 0.6);
      append(scene.room,
             moved(at(place, yaw), box(size, collagePainter({45, 190}, Random(random.next())))));
    }
    const Eigen::Vector2d place(depth - 0.9, side * random.uniform(1.4, 1.9));
    const double width = random.uniform(0.14, 0.2);
    const double yaw = random.uniform(0, 1);
    addPillar(scene, place, width, yaw, woodPainter(Random(random.next())));
  }
}

Wave wobble(double amplitude, double frequency, Random& random) {
  return {0, 0, amplitude, frequency, random.uniform(0, 2 * M_PI)};
}

void addString(Body& body, double top, double end) {
  for (Face& face :
       moved(at({0, 0, (top + end) / 2}), box({0.012, 0.012, end - top}, plainPainter(35)))) {
    face.counts = false;
    body.faces.push_back(face);
  }
}

Body hangingBlock(Scene& scene, double side, const Pendulum& swing) {
  const auto number = static_cast<std::uint64_t>(scene.bodies.size());
  Body body;
  body.faces = box(Eigen::Vector3d::Constant(side),
                   collagePainter({10, 245}, randomOf(scene, kSurface + number)));
  addString(body, side / 2, swing.length);
  body.T_world_body = pendulum(swing);
  return body;
}

Motion walkingCamera(const Scene& scene, double amount) {
  Handheld hand;
  hand.position = {-0.1, 0.05, 1.6};
  hand.sway = amount * Eigen::Vector3d(0.36, 0.27, 0.18);
  hand.turn = amount * Eigen::Vector3d(5.0, 3.5, 6.5) * kDegree;
  return handheld(hand, randomOf(scene, kCamera));
}

}  // namespace mvo::sim
