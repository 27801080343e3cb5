// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What a sensor's calibration messages say: the camera of its rectified images, and how to get
// them.
#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "mvo/frame.hpp"
#include "ros/sensor/rectification.hpp"

namespace mvo_ros {

enum class Sensor { kStereo, kRgbd };

/// Where a sensor's images and calibrations are. For RGB-D `left` is the colour image and `second`
/// the registered depth, which needs no calibration of its own.
struct SensorTopics {
  std::string left;
  std::string left_info;
  std::string second;
  std::string second_info;
};

/// The names of a sensor's topics, raw or rectified, relative to its namespace.
SensorTopics relativeTopics(Sensor sensor, bool raw);
/// The same in the sensor's usual namespace.
SensorTopics usualTopics(Sensor sensor, bool raw);

/// How the messages of a sensor are to be understood.
struct SensorSetup {
  Sensor sensor = Sensor::kStereo;
  bool raw = false;  ///< the images still need rectification
  SensorTopics topics = usualTopics(Sensor::kStereo, false);
  double virtual_baseline = mvo::FrontendOptions().virtual_baseline;  ///< RGB-D [m]
};

class SensorModel {
 public:
  /// `second` is not looked at for RGB-D. Throws std::runtime_error, one sentence that begins with
  /// the topic at fault.
  SensorModel(const SensorSetup& setup, const sensor_msgs::CameraInfo& left,
              const sensor_msgs::CameraInfo& second);

  const mvo::StereoCamera& camera() const { return camera_; }
  bool rectifies() const { return left_.has_value(); }
  /// A frame of grey images (RGB-D: grey and depth), rectified if they are raw.
  mvo::Frame frame(std::int64_t stamp_ns, const cv::Mat& left, const cv::Mat& second) const;

 private:
  Sensor sensor_;
  mvo::StereoCamera camera_;
  std::optional<Rectification> left_;
  std::optional<Rectification> second_;
};

}  // namespace mvo_ros
