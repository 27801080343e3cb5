// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/dots.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "sim/random.hpp"
#include "sim/view.hpp"

namespace mvo::sim {
namespace {

constexpr std::uint64_t kDotStream = 400;  // beside those of scenes
constexpr double kSpread = 0.1;            // the pattern reaches beyond the image by this share
constexpr double kPeakAtOneMetre = 700;    // [grey levels]
constexpr double kBrightest = 150;         // [grey levels]
constexpr double kWidth = 0.8;             // standard deviation of a dot [px]
constexpr double kSameSurface = 1e-3;      // relative difference of inverse depths

using Dots = std::vector<std::optional<SeenDot>>;

// Between the eyes, with the left one's view.
Eye projectorOf(const Scene& scene) {
  Eye projector;
  projector.lens = scene.camera;
  projector.T_eye_camera.translation().x() = -scene.camera.baseline / 2;
  return projector;
}

// Where the dots leave the projector, in pixels of its view.
std::vector<Eigen::Vector2d> pattern(const Scene& scene) {
  Random random({scene.seed, kDotStream});
  std::vector<Eigen::Vector2d> points;
  for (int i = 0; i < scene.options.imperfections.dots; ++i) {
    const double u = random.uniform(-kSpread, 1 + kSpread) * scene.camera.width;
    const double v = random.uniform(-kSpread, 1 + kSpread) * scene.camera.height;
    points.emplace_back(u, v);
  }
  return points;
}

// What an eye sees along single rays, given as pixels without distortion.
Visibility probe(const Scene& scene, double time, const Eye& eye,
                 const std::vector<Eigen::Vector2d>& pixels) {
  const Grid grid = sampleGrid(eye.lens, 1);
  return visibility(projectScene(scene, time, eye, grid), grid, BentRays{{0, 1}, pixels});
}

// Some dots of the pattern at one time.
void castDots(const Scene& scene, double time, const Eye& eye,
              const std::vector<Eigen::Vector2d>& points, const std::vector<std::size_t>& chosen,
              Dots& dots) {
  const Eye projector = projectorOf(scene);
  std::vector<Eigen::Vector2d> sent;
  sent.reserve(chosen.size());
  for (const std::size_t i : chosen) sent.push_back(points[i]);
  const Visibility lit = probe(scene, time, projector, sent);
  const Eigen::Isometry3d T_eye_projector = eye.T_eye_camera * projector.T_eye_camera.inverse();
  Eye pinhole = eye;
  pinhole.distortion = {};
  std::vector<Eigen::Vector3d> p_eye;
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    const StereoCamera& lens = projector.lens;
    const Eigen::Vector3d ray((sent[k].x() - lens.cu) / lens.fu, (sent[k].y() - lens.cv) / lens.fv,
                              1);
    // A ray that meets nothing goes on a kilometre, where the eye sees nothing either.
    const double depth = lit.index[k] == 0 ? 1000 : 1.0 / lit.inverse_depth[k];
    p_eye.emplace_back(T_eye_projector * (depth * ray));
    pixels.push_back(pinhole.project(p_eye.back()));
  }
  const Visibility seen = probe(scene, time, eye, pixels);
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    dots[chosen[k]].reset();
    if (lit.index[k] == 0 || seen.index[k] == 0) continue;
    if (std::abs(seen.inverse_depth[k] * p_eye[k].z() - 1) > kSameSurface) continue;
    const double inverse_depth = lit.inverse_depth[k];
    dots[chosen[k]] =
        SeenDot{eye.project(p_eye[k]),
                std::min(kBrightest, kPeakAtOneMetre * inverse_depth * inverse_depth)};
  }
}

}  // namespace

std::vector<std::optional<SeenDot>> seenDots(const Scene& scene, double time, const Eye& eye) {
  const std::vector<Eigen::Vector2d> points = pattern(scene);
  Dots dots(points.size());
  std::vector<std::size_t> all(points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  castDots(scene, time + eye.delay, eye, points, all, dots);
  if (eye.readout == 0) return dots;
  // A dot hardly changes its row, so the row at the frame's stamp gives its time.
  std::map<long, std::vector<std::size_t>> of_row;
  for (const std::size_t i : all)
    if (dots[i]) of_row[std::lround(dots[i]->pixel.y())].push_back(i);
  for (const auto& [row, chosen] : of_row)
    castDots(scene, time + eye.rowTime(static_cast<double>(row)), eye, points, chosen, dots);
  return dots;
}

void addDots(const Scene& scene, double time, const Eye& eye, cv::Mat& light) {
  constexpr int kReach = 3;  // [px]
  for (const auto& dot : seenDots(scene, time, eye)) {
    if (!dot) continue;
    const Eigen::Vector2d& center = dot->pixel;
    const cv::Point middle(static_cast<int>(std::lround(center.x())),
                           static_cast<int>(std::lround(center.y())));
    const cv::Rect around(middle.x - kReach, middle.y - kReach, 2 * kReach + 1, 2 * kReach + 1);
    const cv::Rect inside = around & cv::Rect({}, light.size());
    for (int v = inside.y; v < inside.y + inside.height; ++v) {
      for (int u = inside.x; u < inside.x + inside.width; ++u) {
        const double square = (Eigen::Vector2d(u, v) - center).squaredNorm();
        light.at<float>(v, u) +=
            static_cast<float>(dot->peak * std::exp(-square / (2 * kWidth * kWidth)));
      }
    }
  }
}

}  // namespace mvo::sim
