// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/parameters/node_options.hpp"

#include <stdexcept>

#include "option_table.hpp"

namespace mvo_ros {

std::vector<mvo::OptionEntry> nodeOptionTable(NodeOptions& o) {
  mvo::OptionTable t;
  t.word("odom_frame", o.odom_frame, "frame of the odometry and of all motions");
  t.word("base_frame", o.base_frame,
         "frame of the robot, fixed to the camera by TF; empty: the left optical frame itself");
  t.flag("publish_tf", o.publish_tf, "TF from odom_frame to the base frame");
  t.flag("invert_tf", o.invert_tf,
         "publish it with the base frame as the parent, where odometry has another parent already");
  t.flag("publish_motion_tf", o.publish_motion_tf, "TF from odom_frame to each motion's frame");
  t.word("motion_frame_prefix", o.motion_frame_prefix, "a motion's frame is this and its id");
  t.flag("publish_points", o.publish_points, "the labelled cloud, while somebody listens");
  t.flag("publish_segmentation", o.publish_segmentation,
         "the image of labelled tracklets, while somebody listens");
  t.flag("publish_path", o.publish_path, "the path, while somebody listens");
  t.word("image_transport", o.image_transport, "raw, compressed or another that is installed");
  t.word("depth_transport", o.depth_transport, "the same of depth images");
  t.flag("rectify", o.rectify, "the images are raw: rectify them by their camera_info");
  t.word("mask", o.mask,
         "image file of the left image's size, rectified, 0 where nothing is to be looked at (a "
         "hood, an arm, a logo); empty: none. A latched image on the topic mask replaces it");
  t.word("camera_errors", o.camera_errors,
         "file of what an earlier run learnt of the stereo pair's own error (~save_camera_errors, "
         "bag --save-camera-errors), to start from; empty: none");
  t.flag("approximate_sync", o.approximate_sync, "pair messages whose stamps differ");
  t.number("max_interval", o.max_interval, 0.0, 10.0, "s",
           "largest difference of stamps in an approximate set");
  t.number("sync_queue", o.sync_queue, 1, 1000, "", "messages per topic that wait for their set");
  t.choice("queue", o.queue, {"newest", "all"},
           "of the frames that wait: work on the newest and drop the others, or on all");
  t.number("queue_limit", o.queue_limit, 1, 1000000, "frames",
           "with queue all: how many may wait before the oldest is dropped");
  t.flag("realtime", o.realtime,
         "with queue newest: follow fewer features, down to 150, when steps near the frame period; "
         "queue all has all of them and the same results on every machine");
  t.number("threads", o.threads, 0, 1024, "",
           "that share a step's work, of the whole process (in a manager, of its other nodelets' "
           "OpenCV too); 0: one per processor. Results do not depend on it");
  t.number("history", o.history, 1.0, 1e6, "s", "how far back ~save_trajectories reaches");
  t.number("path_length", o.path_length, 1, 1000000, "poses", "of ~path");
  return t.rows;
}

void NodeOptions::validate() const {
  NodeOptions copy = *this;
  for (auto& row : nodeOptionTable(copy)) row.set(row.get());
  if (odom_frame.empty()) throw std::invalid_argument("option odom_frame is empty");
  if (base_frame == odom_frame)
    throw std::invalid_argument("option base_frame is '" + base_frame +
                                "', it must differ from odom_frame");
}

}  // namespace mvo_ros
