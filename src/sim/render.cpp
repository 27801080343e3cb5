// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "mvo/sim.hpp"
#include "sim/random.hpp"
#include "sim/raster.hpp"
#include "sim/shading.hpp"

namespace mvo::sim {
namespace {

constexpr int kSamples = 2;  // per pixel, along each side

enum Eye : std::uint64_t { kLeft = 0, kRight = 1 };

// Lambert's law under a lamp above and behind the camera, with some light from everywhere.
float brightness(const Eigen::Vector3d& normal_world) {
  const Eigen::Vector3d to_lamp = Eigen::Vector3d(-0.60, 0.25, 0.76).normalized();
  return static_cast<float>(0.72 + 0.33 * std::max(0.0, normal_world.dot(to_lamp)));
}

// All faces of a time that an eye may see. Faces of the scene must outlive the result.
std::vector<ProjectedFace> projectScene(const Scene& scene, double time, Eye eye,
                                        const Grid& grid) {
  Eigen::Isometry3d T_eye_camera = Eigen::Isometry3d::Identity();
  if (eye == kRight) T_eye_camera.translation().x() = -scene.camera.baseline;
  const Eigen::Isometry3d T_eye_world = T_eye_camera * scene.T_world_camera(time).inverse();
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
    add(scene.bodies[i].faces, scene.bodies[i].T_world_body(time), static_cast<int>(i) + 1);
  }
  add(scene.room, Eigen::Isometry3d::Identity(), 0);
  return projected;
}

// The image before the sensor; grey, or blue, green and red.
cv::Mat light(const Scene& scene, double time, Eye eye) {
  const SceneOptions& options = scene.options;
  const Grid grid = sampleGrid(scene.camera, kSamples);
  const int exposures = options.blur > 0 ? options.blur_samples : 1;
  cv::Mat sum =
      cv::Mat::zeros(scene.camera.height, scene.camera.width, options.rgbd ? CV_32FC3 : CV_32FC1);
  for (int i = 0; i < exposures; ++i) {
    const double offset = ((i + 0.5) / exposures - 0.5) * options.blur / options.rate_hz;
    const std::vector<ProjectedFace> faces = projectScene(scene, time + offset, eye, grid);
    shade(faces, visibility(faces, grid), kSamples, 1.0F / static_cast<float>(exposures), sum);
  }
  return sum;
}

// Pixels of a body that nothing hides, inside and outside the image.
std::pair<int, int> silhouette(const std::vector<ProjectedFace>& faces, int label,
                               const Grid& grid) {
  Eigen::AlignedBox2d bounds;
  for (const ProjectedFace& face : faces) {
    if (face.label != label || !face.face->counts) continue;
    for (const Eigen::Vector2d& corner : face.outline) bounds.extend(corner);
  }
  if (bounds.isEmpty()) return {0, 0};
  // A body that touches the camera would cover the plane of the image without end.
  const double margin = 4.0 * std::max(grid.width, grid.height);
  const Eigen::Vector2d low(-margin, -margin);
  const Eigen::Vector2d high(grid.width + margin, grid.height + margin);
  bounds = bounds.intersection(Eigen::AlignedBox2d(low, high));
  if (bounds.isEmpty()) return {0, 0};
  const Eigen::Vector2i origin = bounds.min().array().floor().cast<int>();
  const Eigen::Vector2i size = bounds.max().array().ceil().cast<int>() - origin.array() + 1;
  cv::Mat covered = cv::Mat::zeros(size.y(), size.x(), CV_8UC1);
  for (const ProjectedFace& face : faces) {
    if (face.label != label || !face.face->counts) continue;
    std::vector<Eigen::Vector2d> outline = face.outline;
    for (Eigen::Vector2d& corner : outline) corner -= origin.cast<double>();
    for (int row = 0; row < size.y(); ++row) {
      const Span span = spanOf(outline, row, size.x());
      std::fill_n(covered.ptr(row) + span.first, span.last - span.first + 1, std::uint8_t{1});
    }
  }
  const cv::Rect image(-origin.x(), -origin.y(), grid.width, grid.height);
  const cv::Rect inside = image & cv::Rect(0, 0, size.x(), size.y());
  return {cv::countNonZero(covered), inside.area() > 0 ? cv::countNonZero(covered(inside)) : 0};
}

// Mask, depth and visibility at the centres of the left image's pixels.
void addTruth(const Scene& scene, double time, RenderedFrame& out) {
  const Grid grid = sampleGrid(scene.camera, 1);
  const std::vector<ProjectedFace> faces = projectScene(scene, time, kLeft, grid);
  const Visibility seen = visibility(faces, grid);
  out.mask = cv::Mat::zeros(grid.height, grid.width, CV_8UC1);
  out.depth = cv::Mat(grid.height, grid.width, CV_32FC1,
                      cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  std::vector<int> visible(scene.bodies.size() + 1, 0);
  for (int row = 0; row < grid.height; ++row) {
    for (int column = 0; column < grid.width; ++column) {
      const std::size_t sample = static_cast<std::size_t>(row) * grid.width + column;
      if (seen.index[sample] == 0) continue;
      const ProjectedFace& face = faces[seen.index[sample] - 1];
      out.mask.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(face.label);
      out.depth.at<float>(row, column) = 1.0F / seen.inverse_depth[sample];
      if (face.face->counts) ++visible[face.label];
    }
  }
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const int label = static_cast<int>(i) + 1;
    const auto [whole, inside] = silhouette(faces, label, grid);
    BodyVisibility object;
    object.body = label;
    object.visible_px = visible[label];
    object.image_share = visible[label] / (1.0 * grid.width * grid.height);
    object.silhouette_px = whole;
    object.inframe_share = whole > 0 ? inside / (1.0 * whole) : 0.0;
    object.visible_share = whole > 0 ? visible[label] / (1.0 * whole) : 0.0;
    out.objects.push_back(object);
  }
}

}  // namespace

RenderedFrame render(const Scene& scene, int frame) {
  const double time = scene.time(frame);
  const SceneOptions& options = scene.options;
  const auto noise_seed = [&](Eye eye) {
    return Random({scene.seed, static_cast<std::uint64_t>(frame), eye}).next();
  };
  RenderedFrame out;
  out.frame = frame;
  out.stamp_ns = scene.stampNs(frame);
  out.T_world_camera = scene.T_world_camera(time);
  for (const Body& body : scene.bodies) out.T_world_bodies.push_back(body.T_world_body(time));
  addTruth(scene, time, out);
  const cv::Mat left = expose(light(scene, time, kLeft), 1.0, options.noise, noise_seed(kLeft));
  if (options.rgbd) {
    out.color = left;
    cv::cvtColor(left, out.left, cv::COLOR_BGR2GRAY);
  } else {
    out.left = left;
    out.right = expose(light(scene, time, kRight), options.gain, options.noise, noise_seed(kRight));
  }
  return out;
}

Frame toFrame(const RenderedFrame& rendered) {
  Frame frame;
  frame.stamp_ns = rendered.stamp_ns;
  frame.left = rendered.left;
  frame.right = rendered.right;
  if (rendered.right.empty()) frame.depth = rendered.depth;
  return frame;
}

SequenceFrame toSequenceFrame(const RenderedFrame& rendered) {
  SequenceFrame frame;
  frame.stamp_ns = rendered.stamp_ns;
  if (rendered.right.empty()) {
    frame.left = rendered.color;
    cv::Mat depth = rendered.depth.clone();
    cv::patchNaNs(depth, 0.0);
    depth.convertTo(frame.right, CV_16U, 1000.0);
  } else {
    frame.left = rendered.left;
    frame.right = rendered.right;
  }
  frame.T_world_camera = rendered.T_world_camera;
  for (std::size_t i = 0; i < rendered.T_world_bodies.size(); ++i) {
    frame.T_world_bodies[static_cast<int>(i) + 1] = rendered.T_world_bodies[i];
  }
  frame.mask = rendered.mask;
  frame.objects = rendered.objects;
  return frame;
}

SequenceInfo sequenceInfo(const Scene& scene) {
  return {scene.options.rgbd, scene.camera, scene.options.rate_hz};
}

}  // namespace mvo::sim
