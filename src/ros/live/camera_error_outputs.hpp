// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the node says of the stereo pair's own error: a topic, a corrected calibration, a file.
#pragma once

#include <mvo/CameraErrors.h>
#include <mvo/GetCameraInfo.h>
#include <mvo/SaveCameraErrors.h>
#include <ros/ros.h>

#include <mutex>
#include <optional>
#include <vector>

#include "ros/live/odometry_session.hpp"

namespace mvo_ros {

/// The message of a report.
mvo::CameraErrors cameraErrorsMessage(const std_msgs::Header& header,
                                      const mvo::CameraErrorReport& report);

/// Whether a message says something else than the last one, or that one is some seconds old.
bool isWorthSaying(const mvo::CameraErrors& now, const mvo::CameraErrors& last);

/// Keeps what the newest step knew. Safe from any thread.
class CameraErrorOutputs {
 public:
  explicit CameraErrorOutputs(ros::NodeHandle pnh);

  /// Publishes if it is worth it.
  void step(const Step& step);
  /// Ends the services.
  void shutdown() { services_.clear(); }

 private:
  bool onGetCameraInfo(mvo::GetCameraInfo::Request& request,
                       mvo::GetCameraInfo::Response& response);
  bool onSave(mvo::SaveCameraErrors::Request& request, mvo::SaveCameraErrors::Response& response);

  struct Known {
    std::optional<mvo::CameraErrorReport> report;
    sensor_msgs::CameraInfoConstPtr left;
    sensor_msgs::CameraInfoConstPtr right;
  };
  // Of the newest step. Throws std::runtime_error, one sentence, if it knew nothing.
  Known known();

  std::mutex mutex_;  // of the following
  std::optional<Known> known_;
  std::optional<mvo::CameraErrors> said_;
  ros::Publisher topic_;
  std::vector<ros::ServiceServer> services_;
};

}  // namespace mvo_ros
