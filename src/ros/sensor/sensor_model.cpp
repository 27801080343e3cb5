// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/sensor_model.hpp"

#include "ros/sensor/camera_from_info.hpp"

namespace mvo_ros {

SensorTopics relativeTopics(Sensor sensor, bool raw) {
  if (sensor == Sensor::kRgbd)
    return {raw ? "rgb/image_raw" : "rgb/image_rect_color", "rgb/camera_info",
            raw ? "depth_registered/image_raw" : "depth_registered/image_rect", ""};
  const std::string image = raw ? "/image_raw" : "/image_rect";
  return {"left" + image, "left/camera_info", "right" + image, "right/camera_info"};
}

SensorTopics usualTopics(Sensor sensor, bool raw) {
  SensorTopics topics = relativeTopics(sensor, raw);
  for (std::string* name : {&topics.left, &topics.left_info, &topics.second, &topics.second_info})
    if (!name->empty()) name->insert(0, sensor == Sensor::kRgbd ? "/camera/" : "/stereo/");
  return topics;
}

SensorModel::SensorModel(const SensorSetup& setup, const sensor_msgs::CameraInfo& left,
                         const sensor_msgs::CameraInfo& second)
    : sensor_(setup.sensor) {
  const SensorTopics& topics = setup.topics;
  if (sensor_ == Sensor::kRgbd) {
    camera_ = rgbdCamera(left, setup.virtual_baseline, topics.left_info);
    if (setup.raw) second_ = left_.emplace(left, topics.left_info);  // registered: the same pixels
    return;
  }
  const sensor_msgs::CameraInfo right = setup.raw ? alignedRight(left, second) : second;
  camera_ = stereoCamera(left, right, topics.left_info, topics.second_info);
  if (setup.raw) {
    left_.emplace(left, topics.left_info);
    second_.emplace(right, topics.second_info);
  }
}

mvo::Frame SensorModel::frame(std::int64_t stamp_ns, const cv::Mat& left,
                              const cv::Mat& second) const {
  mvo::Frame frame;
  frame.stamp_ns = stamp_ns;
  frame.left = left_ ? left_->grey(left) : left;
  if (sensor_ == Sensor::kRgbd)
    frame.depth = second_ ? second_->depth(second) : second;
  else
    frame.right = second_ ? second_->grey(second) : second;
  return frame;
}

}  // namespace mvo_ros
