// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the live node can be told beside the method's options: frames, topics, queues, outputs.
#pragma once

#include <string>
#include <vector>

#include "mvo/options.hpp"

namespace mvo_ros {

enum class QueuePolicy { kNewest, kAll };

struct NodeOptions {
  std::string odom_frame = "odom";
  std::string base_frame;  ///< empty: the left optical frame itself
  bool publish_tf = true;
  bool invert_tf = false;
  bool publish_motion_tf = true;
  std::string motion_frame_prefix = "motion_";
  bool publish_points = true;
  bool publish_segmentation = true;
  bool publish_path = true;
  std::string image_transport = "raw";
  std::string depth_transport = "raw";
  std::string mask;           ///< image file; empty: none
  std::string camera_errors;  ///< file of an earlier run; empty: none
  bool rectify = false;
  bool approximate_sync = false;
  double max_interval = 0.02;  ///< [s]
  int sync_queue = 10;
  QueuePolicy queue = QueuePolicy::kNewest;
  int queue_limit = 1000;  ///< frames
  bool realtime = true;    ///< with queue newest
  int threads = 0;         ///< 0: one per processor
  double history = 3600;   ///< [s]
  int path_length = 5000;  ///< poses

  /// Throws std::invalid_argument: one sentence with the parameter's name, value and range.
  void validate() const;
};

/// The table over a NodeOptions object, which must outlive it.
std::vector<mvo::OptionEntry> nodeOptionTable(NodeOptions& options);

}  // namespace mvo_ros
