// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Images of a scene with exact truth: poses, label masks, depth and how much of each body is seen.
#pragma once

#include <vector>

#include "mvo/io/sequence.hpp"
#include "mvo/odometry.hpp"
#include "mvo/sim/scene.hpp"

namespace mvo::sim {

/// Poses and masks belong to the middle of the exposure and to the centres of the pixels.
struct RenderedFrame {
  int frame = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1; RGB-D: of `color`
  cv::Mat right;  ///< 8UC1; empty for RGB-D
  cv::Mat color;  ///< 8UC3 blue, green, red; empty for stereo
  cv::Mat depth;  ///< 32FC1, of the left image, without noise [m]
  cv::Mat mask;   ///< 8UC1, of the left image: 0 static, 1..n bodies
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<Eigen::Isometry3d> T_world_bodies;
  std::vector<ObjectVisibility> objects;  ///< one per body
};

/// The same scene and frame give the same bytes, in any order and from any number of threads.
RenderedFrame render(const Scene& scene, int frame);

/// What the library reads: grey stereo pair, or grey image and depth.
Frame toFrame(const RenderedFrame& rendered);

/// What goes into folders and bags; depth is rounded to millimetres.
SequenceFrame toSequenceFrame(const RenderedFrame& rendered);

/// The camera, kind and rate of a scene.
SequenceInfo sequenceInfo(const Scene& scene);

}  // namespace mvo::sim
