// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/simulator/simulated_sensor.hpp"

#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseArray.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/image_encodings.h>
#include <tf2_eigen/tf2_eigen.h>

#include "ros/sensor/camera_info_message.hpp"
#include "ros/sensor/mount.hpp"

namespace mvo_ros {

namespace {

namespace encodings = sensor_msgs::image_encodings;

constexpr unsigned kQueue = 2;

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame;
  return header;
}

// Base: x forward, z up, below the middle of the camera; optical: z forward, x right.
Eigen::Isometry3d mountOf(const mvo::SequenceInfo& info) {
  constexpr double kAhead = 0.1;  // m
  constexpr double kAbove = 0.3;  // m
  Eigen::Isometry3d T_base_camera = Eigen::Isometry3d::Identity();
  T_base_camera.linear() = rosFromOptical();
  T_base_camera.translation() << kAhead, info.rgbd ? 0 : info.camera.baseline / 2, kAbove;
  return T_base_camera;
}

}  // namespace

SimulatedSensor::SimulatedSensor(const SimulatorOptions& options, const mvo::SequenceInfo& info,
                                 const ros::NodeHandle& nh, const ros::NodeHandle& pnh)
    : options_(options),
      info_(info),
      left_frame_(info.rgbd ? "camera_rgb_optical" : "camera_left_optical"),
      right_frame_(info.rgbd ? left_frame_ : "camera_right_optical"),
      T_base_camera_(mountOf(info)),
      transport_(nh) {
  ros::NodeHandle topics(nh);
  const bool rgbd = info.rgbd;
  left_ = transport_.advertise(rgbd ? "rgb/image_rect_color" : "left/image_rect", kQueue);
  right_ = transport_.advertise(rgbd ? "depth_registered/image_rect" : "right/image_rect", kQueue);
  left_info_ = topics.advertise<sensor_msgs::CameraInfo>(
      rgbd ? "rgb/camera_info" : "left/camera_info", kQueue);
  right_info_ = topics.advertise<sensor_msgs::CameraInfo>(
      rgbd ? "depth_registered/camera_info" : "right/camera_info", kQueue);
  ros::NodeHandle truth(pnh, "truth");
  odometry_ = truth.advertise<nav_msgs::Odometry>("odometry", 100);
  bodies_ = truth.advertise<geometry_msgs::PoseArray>("bodies", 100);
  sendMount();
}

void SimulatedSensor::sendMount() {
  const auto send = [this](const std::string& child, const Eigen::Isometry3d& T_base_child) {
    geometry_msgs::TransformStamped message = tf2::eigenToTransform(T_base_child);
    message.header = headerOf(ros::Time::now(), options_.base_frame);
    message.child_frame_id = child;
    mount_.sendTransform(message);
  };
  send(left_frame_, T_base_camera_);
  if (!info_.rgbd)
    send(right_frame_, T_base_camera_ * Eigen::Translation3d(info_.camera.baseline, 0, 0));
}

bool SimulatedSensor::isWatched() const {
  return left_.getNumSubscribers() > 0 && right_.getNumSubscribers() > 0 &&
         left_info_.getNumSubscribers() > 0 && (info_.rgbd || right_info_.getNumSubscribers() > 0);
}

void SimulatedSensor::publish(const mvo::SequenceFrame& frame, const ros::Time& stamp) {
  publishTruth(frame, stamp);
  publishImages(frame, stamp);
}

void SimulatedSensor::publishImages(const mvo::SequenceFrame& frame, const ros::Time& stamp) const {
  const auto left = headerOf(stamp, left_frame_);
  const auto right = headerOf(stamp, right_frame_);
  left_info_.publish(cameraInfo(left, info_.camera, 0));
  right_info_.publish(cameraInfo(right, info_.camera, info_.rgbd ? 0 : info_.camera.baseline));
  const auto send = [](const image_transport::Publisher& publisher, const std_msgs::Header& header,
                       const std::string& encoding, const cv::Mat& pixels) {
    if (publisher.getNumSubscribers() > 0)
      publisher.publish(cv_bridge::CvImage(header, encoding, pixels).toImageMsg());
  };
  send(left_, left, info_.rgbd ? encodings::BGR8 : encodings::MONO8, frame.left);
  send(right_, right, info_.rgbd ? encodings::TYPE_16UC1 : encodings::MONO8, frame.right);
}

void SimulatedSensor::publishTruth(const mvo::SequenceFrame& frame, const ros::Time& stamp) {
  const Eigen::Isometry3d T_world_base = *frame.T_world_camera * T_base_camera_.inverse();
  const bool first = !T_odom_world_;
  if (first) T_odom_world_ = T_world_base.inverse();
  const Eigen::Isometry3d T_odom_base = *T_odom_world_ * T_world_base;
  const Eigen::Isometry3d before = first ? T_odom_base : T_odom_base_;
  const Eigen::Isometry3d step = before.inverse() * T_odom_base;
  T_odom_base_ = T_odom_base;

  nav_msgs::Odometry odometry;
  odometry.header = headerOf(stamp, options_.odom_frame);
  odometry.child_frame_id = options_.base_frame;
  odometry.pose.pose = tf2::toMsg(T_odom_base);
  const Eigen::AngleAxisd turn(step.linear());
  tf2::toMsg(Eigen::Vector3d(info_.rate_hz * step.translation()), odometry.twist.twist.linear);
  tf2::toMsg(Eigen::Vector3d(info_.rate_hz * turn.angle() * turn.axis()),
             odometry.twist.twist.angular);
  odometry_.publish(odometry);

  geometry_msgs::PoseArray bodies;
  bodies.header = odometry.header;
  for (const auto& [id, T_world_body] : frame.T_world_bodies)
    bodies.poses.push_back(tf2::toMsg(*T_odom_world_ * T_world_body));
  bodies_.publish(bodies);
}

}  // namespace mvo_ros
