// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/view.hpp"

#include <algorithm>
#include <utility>

#include "sim/dots.hpp"
#include "sim/shading.hpp"

namespace mvo::sim {
namespace {

constexpr int kSamples = 2;  // per pixel, along each side

// Lambert's law under a lamp above and behind the camera, with some light from everywhere.
float brightness(const Eigen::Vector3d& normal_world) {
  const Eigen::Vector3d to_lamp = Eigen::Vector3d(-0.60, 0.25, 0.76).normalized();
  return static_cast<float>(0.72 + 0.33 * std::max(0.0, normal_world.dot(to_lamp)));
}

}  // namespace

std::vector<ProjectedFace> projectScene(const Scene& scene, double time, const Eye& eye,
                                        const Grid& grid) {
  const Eigen::Isometry3d T_world_camera = scene.T_world_camera(time);
  const Eigen::Isometry3d T_eye_world = eye.T_eye_camera * T_world_camera.inverse();
  std::vector<ProjectedFace> projected;
  const auto add = [&](const std::vector<Face>& faces, const Eigen::Isometry3d& T_world_body,
                       int label) {
    for (const Face& face : faces) {
      if (auto seen = project(face, T_eye_world * T_world_body, grid)) {
        seen->label = label;
        seen->shade = brightness(T_world_body.linear() * face.normal);
        projected.push_back(std::move(*seen));
      }
    }
  };
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const Body& body = scene.bodies[i];
    const Eigen::Isometry3d T_world_body = body.T_world_body(time);
    add(body.faces, T_world_body, static_cast<int>(i) + 1);
    for (const Limb& limb : body.limbs)
      add(limb.faces, T_world_body * limb.T_body_limb(time), static_cast<int>(i) + 1);
  }
  add(scene.room, Eigen::Isometry3d::Identity(), 0);
  add(scene.hood, T_world_camera, kHoodLabel);
  return projected;
}

void lookAt(const Scene& scene, double time, const Eye& eye, int n,
            const std::function<void(const ViewedRows&)>& visit) {
  const Grid grid = sampleGrid(eye.lens, n);
  if (eye.readout == 0 && !eye.distortion.bends()) {
    const auto faces = projectScene(scene, time + eye.delay, eye, grid);
    return visit({faces, visibility(faces, grid)});
  }
  std::vector<ProjectedFace> faces;
  for (int row = 0; row < eye.lens.height; ++row) {
    if (row == 0 || eye.readout != 0)
      faces = projectScene(scene, time + eye.rowTime(row), eye, grid);
    const Rows rows{row * n, n};
    if (!eye.distortion.bends()) {
      visit({faces, visibility(faces, grid, rows)});
    } else {
      const BentRays rays = bentRays(eye, n, rows);
      visit({faces, visibility(faces, grid, rays), &rays});
    }
  }
}

cv::Mat light(const Scene& scene, double time, const Eye& eye) {
  const SceneOptions& options = scene.options;
  const int exposures = options.blur > 0 ? options.blur_samples : 1;
  cv::Mat sum =
      cv::Mat::zeros(scene.camera.height, scene.camera.width, options.rgbd ? CV_32FC3 : CV_32FC1);
  for (int i = 0; i < exposures; ++i) {
    const double offset = ((i + 0.5) / exposures - 0.5) * options.blur / options.rate_hz;
    lookAt(scene, time + offset, eye, kSamples, [&](const ViewedRows& view) {
      shade(view.faces, view.seen, kSamples, 1.0F / static_cast<float>(exposures), sum, view.rays);
    });
  }
  if (options.imperfections.dots > 0) addDots(scene, time, eye, sum);
  return sum;
}

}  // namespace mvo::sim
