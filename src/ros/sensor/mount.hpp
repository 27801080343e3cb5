// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the camera is on the robot, and with it the odometry frame.
#pragma once

#include <Eigen/Geometry>
#include <string>

namespace mvo_ros {

/// The odometry frame is the base frame at the world's start: x forward, y left, z up. Without a
/// base frame the left optical frame takes its place, and the odometry frame is its first pose with
/// those axes.
struct Mount {
  std::string odom_frame;
  std::string base_frame;
  std::string camera_frame;
  Eigen::Isometry3d T_odom_world = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_camera_base = Eigen::Isometry3d::Identity();
};

/// REP 103: optical z is forward, x right, y down; ROS's x is forward, y left, z up.
Eigen::Matrix3d rosFromOptical();

/// For a base frame at T_base_camera.
Mount mountOn(const std::string& odom_frame, const std::string& base_frame,
              const std::string& camera_frame, const Eigen::Isometry3d& T_base_camera);
/// Without a base frame.
Mount mountAlone(const std::string& odom_frame, const std::string& camera_frame);

}  // namespace mvo_ros
