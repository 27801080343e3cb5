// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/mount.hpp"

namespace mvo_ros {

Eigen::Matrix3d rosFromOptical() {
  Eigen::Matrix3d C;
  C << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return C;
}

Mount mountOn(const std::string& odom_frame, const std::string& base_frame,
              const std::string& camera_frame, const Eigen::Isometry3d& T_base_camera) {
  return {odom_frame, base_frame, camera_frame, T_base_camera, T_base_camera.inverse()};
}

Mount mountAlone(const std::string& odom_frame, const std::string& camera_frame) {
  Mount mount{odom_frame, camera_frame, camera_frame};
  mount.T_odom_world.linear() = rosFromOptical();
  return mount;
}

}  // namespace mvo_ros
