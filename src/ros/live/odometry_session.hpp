// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// From sets of messages to estimates, through all that happens to live input: clocks that jump,
// calibrations and sizes that change, images that cannot be read or stand still.
#pragma once

#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <utility>

#include "edges/mask_file.hpp"
#include "mvo/camera_errors.hpp"
#include "mvo/odometry.hpp"
#include "ros/live/synchronized_input.hpp"
#include "ros/sensor/sensor_model.hpp"

namespace mvo_ros {

/// What is known after one set.
struct Step {
  mvo::MultimotionEstimate estimate;
  std::optional<mvo::CameraErrorReport> camera_errors;  ///< none if the pair is trusted
  sensor_msgs::CameraInfoConstPtr left_info;            ///< as it came
  sensor_msgs::CameraInfoConstPtr second_info;          ///< RGB-D: null
  mvo::StereoCamera camera;
  cv::Mat left;                              ///< rectified, 8UC1
  std::string camera_frame_id;               ///< of the left images
  ros::Time stamp;                           ///< of the left image
  std::map<mvo::FrameId, ros::Time> stamps;  ///< of the window's frames
  Eigen::Isometry3d T_world_camera =
      Eigen::Isometry3d::Identity();  ///< lost: where it is taken to be
  std::optional<double> period;       ///< since the frame before [s]
  unsigned resets = 0;                ///< how often the world has been started anew
  std::string notice;                 ///< one sentence if something is odd about the input
  bool restarted = false;             ///< with this frame; the notice says why
  double decode_ms = 0;               ///< images to grey, rectified
  double before_ms = 0;               ///< of total_ms, before the prepared frame was added
  double total_ms = 0;                ///< of work, whoever did it; waiting between is not in it
  ros::WallTime arrival;
};

/// One calibration's model and odometry.
struct CalibratedOdometry {
  SensorModel model;
  mvo::MultimotionOdometry odometry;
};

/// A set whose images are read, rectified and prepared for the calibration that came with them.
struct PreparedSet {
  InputSet set;
  std::shared_ptr<CalibratedOdometry> calibrated;
  cv::Mat left;  ///< rectified, 8UC1
  mvo::PreparedFrame frame;
  double decode_ms = 0;
};

/// What of the work depends on a set alone, so that another thread can do it while a step is under
/// way. Not safe from several threads.
class SetPreparation {
 public:
  SetPreparation(const SensorSetup& setup, const mvo::Options& options);

  /// Takes the set's calibration. Throws std::runtime_error, one sentence that names the topic, for
  /// a set that cannot be used; everything else goes on as it was.
  PreparedSet prepare(const InputSet& set);

  /// From the next set on.
  void setMask(Mask mask) { mask_ = std::move(mask); }
  /// What the pair's own error is known to be before the first set. Sets of another camera are
  /// refused; `source` is named then.
  void setCameraErrors(mvo::LearntCameraErrors learnt, std::string source);

 private:
  void adopt(const InputSet& set);
  cv::Mat checked(const cv::Mat& image, const std::string& topic) const;

  SensorSetup setup_;
  mvo::Options options_;
  Mask mask_;
  std::optional<mvo::LearntCameraErrors> camera_errors_;
  std::string camera_errors_source_;
  std::string fingerprint_;  // of the calibration in force
  std::shared_ptr<CalibratedOdometry> calibrated_;
};

/// Owns what is known. Not safe from several threads.
class OdometrySession {
 public:
  OdometrySession(SensorTopics topics, const mvo::Options& options);

  /// A set of another calibration than the last one's starts a new world. Throws
  /// std::runtime_error, one sentence that names the topic, for a set that cannot be used;
  /// everything else goes on as it was.
  Step add(PreparedSet prepared);
  /// The next frame starts a new world.
  void reset(const std::string& reason);
  /// Throws like MultimotionOdometry::setOptions.
  void setOptions(const mvo::Options& options);

 private:
  void adopt(const PreparedSet& prepared);

  SensorTopics topics_;
  mvo::Options options_;
  std::shared_ptr<CalibratedOdometry> calibrated_;
  std::optional<std::string> restart_;  // why the next frame starts a new world
  unsigned resets_ = 0;
  ros::Time last_stamp_;
  cv::Mat last_left_;
  int frozen_ = 0;  // frames in a row that show the same
  std::map<mvo::FrameId, ros::Time> stamps_;
};

}  // namespace mvo_ros
