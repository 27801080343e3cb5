// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/truth.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/view.hpp"

namespace mvo::sim {
namespace {

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

// Mask and depth; pixels that count towards a label's extent, by label.
std::vector<int> addPixels(const Scene& scene, double time, const Eye& eye, RenderedFrame& out) {
  const cv::Size size(scene.camera.width, scene.camera.height);
  out.mask = cv::Mat::zeros(size, CV_8UC1);
  out.depth = cv::Mat(size, CV_32FC1, cv::Scalar(std::numeric_limits<float>::quiet_NaN()));
  std::vector<int> visible(kHoodLabel + 1, 0);
  lookAt(scene, time, eye, 1, [&](const ViewedRows& view) {
    std::size_t sample = 0;
    for (int row = view.seen.rows.first; row < view.seen.rows.first + view.seen.rows.count; ++row) {
      for (int column = 0; column < size.width; ++column, ++sample) {
        if (view.seen.index[sample] == 0) continue;
        const ProjectedFace& face = view.faces[view.seen.index[sample] - 1];
        out.mask.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(face.label);
        out.depth.at<float>(row, column) = 1.0F / view.seen.inverse_depth[sample];
        if (face.face->counts) ++visible[face.label];
      }
    }
  });
  return visible;
}

double share(int part, int whole) { return whole > 0 ? std::min(1.0, part / (1.0 * whole)) : 0.0; }

}  // namespace

void addTruth(const Scene& scene, double time, RenderedFrame& out) {
  const Eye eye = leftEye(scene);
  const Grid grid = sampleGrid(eye.lens, 1);
  const std::vector<int> visible = addPixels(scene, time, eye, out);
  const std::vector<ProjectedFace> faces = projectScene(scene, time, eye, grid);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const int label = static_cast<int>(i) + 1;
    const auto [whole, inside] = silhouette(faces, label, grid);
    BodyVisibility object;
    object.body = label;
    object.visible_px = visible[label];
    object.image_share = visible[label] / (1.0 * grid.width * grid.height);
    object.silhouette_px = whole;
    object.inframe_share = share(inside, whole);
    object.visible_share = share(visible[label], whole);
    out.objects.push_back(object);
  }
}

}  // namespace mvo::sim
