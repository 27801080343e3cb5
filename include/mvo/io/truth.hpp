// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known to be true of a sequence: poses of the camera and of bodies, masks, visibility.
// Real sequences come with less of it; what is missing is empty.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "mvo/io/tum.hpp"

namespace mvo {

/// How much of a body the left image shows at a time.
struct BodyVisibility {
  std::int64_t stamp_ns = 0;
  int body = 0;              ///< >= 1
  double image_share = 0;    ///< of the image that the body covers
  double visible_share = 0;  ///< of the body's silhouette that is in view and not covered
  int visible_px = 0;        ///< pixels that show the body
  int silhouette_px = 0;     ///< pixels, also outside the image, it covers if nothing hides it
  double inframe_share = 0;  ///< of the silhouette that is inside the image
};

/// A body's box in the left image, drawn by hand.
struct TrueBox {
  std::int64_t stamp_ns = 0;
  double x = 0;       ///< left edge [px]
  double y = 0;       ///< upper edge [px]
  double width = 0;   ///< [px]
  double height = 0;  ///< [px]
};

/// The truth of one sequence.
struct Truth {
  std::vector<std::int64_t> stamps_ns;             ///< of every frame, increasing, never empty
  std::vector<StampedPose> camera;                 ///< T_world_camera, left optical frame
  std::map<int, std::vector<StampedPose>> bodies;  ///< T_world_body by id >= 1
  std::vector<BodyVisibility> visibility;          ///< no row = nothing to be seen
  std::vector<TrueBox> boxes;
  /// The mask of the frame with this index: 8UC1, 0 static, else the body's id; an empty function
  /// if there are no masks, an empty image if this frame has none.
  std::function<cv::Mat(std::size_t)> mask;
};

/// Reads times.txt and truth/ (camera.tum, object_<id>.tum, objects.csv, masks/NNNNNN.png,
/// boxes.csv, each optional) of a sequence folder. Throws std::runtime_error naming the file that
/// cannot be read; masks are read when they are asked for.
Truth readTruth(const std::filesystem::path& folder);

}  // namespace mvo
