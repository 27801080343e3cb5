// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A sequence of rectified images with its ground truth, as it goes into a folder or a bag.
#pragma once

#include <cstdint>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "mvo/stereo_camera.hpp"

namespace mvo {

/// How much of a body an image shows.
struct ObjectVisibility {
  int id = 0;                     ///< >= 1, as in the masks
  int visible_px = 0;             ///< pixels that show the body
  double visible_image_frac = 0;  ///< visible_px as a share of the image
  int silhouette_px = 0;          ///< pixels, also outside the image, it covers if nothing hides it
  double inframe_frac = 0;        ///< share of the silhouette inside the image
  double visible_frac = 0;        ///< visible_px as a share of the silhouette
};

/// What holds for all frames of a sequence.
struct SequenceInfo {
  bool rgbd = false;
  StereoCamera camera;
  double rate_hz = 0;
};

/// One frame of a sequence; truth that is not known is left out.
struct SequenceFrame {
  std::int64_t stamp_ns = 0;
  cv::Mat left;   ///< 8UC1 (stereo) or 8UC3 blue, green, red (RGB-D)
  cv::Mat right;  ///< 8UC1 (stereo) or 16UC1 depth [mm], 0 = hole (RGB-D)
  std::optional<Eigen::Isometry3d> T_world_camera;  ///< left optical frame
  std::map<int, Eigen::Isometry3d> T_world_bodies;  ///< by id >= 1
  cv::Mat mask;  ///< 8UC1, of the left image: 0 static, else the body's id; may be empty
  std::vector<ObjectVisibility> objects;
};

}  // namespace mvo
