// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A sequence as a bag with the usual topics and its truth beside them:
//   stereo  /stereo/{left,right}/image_rect (mono8), /stereo/{left,right}/camera_info
//   RGB-D   /camera/rgb/image_rect_color (bgr8), /camera/rgb/camera_info,
//           /camera/depth_registered/image_rect (16UC1, mm)
//   truth   /truth/camera and /truth/object_<id>: geometry_msgs/PoseStamped, T_world_camera and
//             T_world_body, frame_id "world" (z up)
//           /truth/mask: sensor_msgs/Image mono8 of the left image, 0 static, else the body's id
//           /truth/objects: sensor_msgs/PointCloud, one point per body, the origin of its frame in
//             the left optical frame [m]; the channels "frame", "id", "visible_px",
//             "visible_image_frac", "silhouette_px", "inframe_frac", "visible_frac" have one value
//             per body (see BodyVisibility); "frame" counts from 0.
// Every message of a frame has the frame's stamp, in its header and in the bag.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>

#include <string>

#include "mvo/sequence.hpp"

namespace mvo_ros {

/// Writes one bag, frame by frame. Throws std::runtime_error naming the file.
class TruthBag {
 public:
  TruthBag(const std::string& path, const mvo::SequenceInfo& info);

  void add(const mvo::SequenceFrame& frame);
  /// Without it the bag has no index.
  void close();

 private:
  void writeImages(const mvo::SequenceFrame& frame, const std_msgs::Header& header);
  void writeTruth(const mvo::SequenceFrame& frame, const std_msgs::Header& header);
  template <typename Message>
  void write(const std::string& topic, const Message& message);

  std::string path_;
  mvo::SequenceInfo info_;
  rosbag::Bag bag_;
  unsigned frames_ = 0;
};

}  // namespace mvo_ros
