// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/camera_info_message.hpp"

namespace mvo_ros {

sensor_msgs::CameraInfo cameraInfo(const std_msgs::Header& header, const mvo::StereoCamera& camera,
                                   double baseline) {
  sensor_msgs::CameraInfo info;
  info.header = header;
  info.width = static_cast<unsigned>(camera.width);
  info.height = static_cast<unsigned>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fu, 0, camera.cu, 0, camera.fv, camera.cv, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {camera.fu, 0, camera.cu, -camera.fu * baseline, 0, camera.fv, camera.cv, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace mvo_ros
