// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All that the node says to the world about a step: topics and TF.
#pragma once

#include <image_transport/image_transport.h>
#include <nav_msgs/Path.h>
#include <ros/ros.h>
#include <tf2_ros/transform_broadcaster.h>

#include <deque>
#include <optional>

#include "edges/overlay.hpp"
#include "ros/live/motion_messages.hpp"
#include "ros/parameters/parameters.hpp"

namespace mvo_ros {

class Publisher {
 public:
  Publisher(ros::NodeHandle nh, const NodeOptions& options);

  /// Publishes a step; clouds, images and paths only while somebody listens. Returns the motions as
  /// published.
  mvo::MotionArray publish(const Step& step, const Mount& mount, const Parameters& parameters);

 private:
  void publishTf(const mvo::MotionArray& motions, const nav_msgs::Odometry& odometry,
                 const NodeOptions& options);
  void publishPath(const nav_msgs::Odometry& odometry, bool wanted);

  MotionMessages messages_;
  std::size_t path_length_;
  std::deque<geometry_msgs::PoseStamped> path_;
  std::optional<Overlay> overlay_;
  cv::Size overlay_image_;
  image_transport::ImageTransport transport_;
  ros::Publisher odometry_;
  ros::Publisher path_publisher_;
  ros::Publisher motions_;
  ros::Publisher points_;
  image_transport::Publisher segmentation_;
  tf2_ros::TransformBroadcaster tf_;
};

}  // namespace mvo_ros
