// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The topics of a simulated camera on a robot: images and calibrations as a driver sends them, the
// mount in TF, and the truth.
#pragma once

#include <image_transport/image_transport.h>
#include <ros/ros.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "mvo/sequence.hpp"
#include "ros/simulator/simulator_options.hpp"

namespace mvo_ros {

class SimulatedSensor {
 public:
  /// Advertises, and sends the static transforms.
  SimulatedSensor(const SimulatorOptions& options, const mvo::SequenceInfo& info,
                  const ros::NodeHandle& nh, const ros::NodeHandle& pnh);

  /// Whether every image has a subscriber.
  bool isWatched() const;
  /// Sends everything about a frame, seen at `stamp`. The first one's base frame is the odometry's.
  void publish(const mvo::SequenceFrame& frame, const ros::Time& stamp);

 private:
  void sendMount();
  void publishImages(const mvo::SequenceFrame& frame, const ros::Time& stamp) const;
  void publishTruth(const mvo::SequenceFrame& frame, const ros::Time& stamp);

  SimulatorOptions options_;
  mvo::SequenceInfo info_;
  std::string left_frame_;
  std::string right_frame_;
  Eigen::Isometry3d T_base_camera_;
  tf2_ros::StaticTransformBroadcaster mount_;
  image_transport::ImageTransport transport_;
  image_transport::Publisher left_;
  image_transport::Publisher right_;  ///< RGB-D: depth
  ros::Publisher left_info_;
  ros::Publisher right_info_;
  ros::Publisher odometry_;
  ros::Publisher bodies_;
  std::optional<Eigen::Isometry3d> T_odom_world_;
  Eigen::Isometry3d T_odom_base_ = Eigen::Isometry3d::Identity();  ///< of the frame before
};

}  // namespace mvo_ros
