// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/publisher.hpp"

#include <cv_bridge/cv_bridge.h>
#include <tf2_eigen/tf2_eigen.h>

#include "ros/live/cloud_message.hpp"

namespace mvo_ros {

namespace {

constexpr unsigned kQueue = 10;

geometry_msgs::TransformStamped transform(const std_msgs::Header& header, const std::string& child,
                                          const geometry_msgs::Pose& pose) {
  geometry_msgs::TransformStamped out;
  out.header = header;
  out.child_frame_id = child;
  out.transform.translation.x = pose.position.x;
  out.transform.translation.y = pose.position.y;
  out.transform.translation.z = pose.position.z;
  out.transform.rotation = pose.orientation;
  return out;
}

geometry_msgs::TransformStamped inverted(const geometry_msgs::TransformStamped& T) {
  geometry_msgs::TransformStamped out = tf2::eigenToTransform(tf2::transformToEigen(T).inverse());
  out.header = T.header;
  out.header.frame_id = T.child_frame_id;
  out.child_frame_id = T.header.frame_id;
  return out;
}

}  // namespace

Publisher::Publisher(ros::NodeHandle nh, const NodeOptions& options)
    : messages_(options.motion_frame_prefix),
      path_length_(static_cast<std::size_t>(options.path_length)),
      transport_(nh),
      odometry_(nh.advertise<nav_msgs::Odometry>("odometry", kQueue)),
      path_publisher_(nh.advertise<nav_msgs::Path>("path", 1)),
      motions_(nh.advertise<mvo::MotionArray>("motions", kQueue)),
      points_(nh.advertise<sensor_msgs::PointCloud2>("points", kQueue)),
      segmentation_(transport_.advertise("segmentation", 1)) {}

mvo::MotionArray Publisher::publish(const Step& step, const Mount& mount,
                                    const Parameters& parameters) {
  const NodeOptions& options = parameters.node;
  mvo::MotionArray motions = messages_.motions(step, mount);
  const nav_msgs::Odometry odometry = odometryMessage(motions, step, mount);
  publishTf(motions, odometry, options);
  odometry_.publish(odometry);
  motions_.publish(motions);
  if (step.restarted) {
    path_.clear();
    overlay_.reset();
  }
  publishPath(odometry, options.publish_path);
  if (options.publish_points && points_.getNumSubscribers() > 0)
    points_.publish(cloudMessage(step, parameters.method.frontend.min_disparity));
  // Tails need the frames before: drawing goes on from the first listener's arrival.
  if (options.publish_segmentation && segmentation_.getNumSubscribers() > 0) {
    if (!overlay_ || overlay_image_ != step.left.size()) overlay_.emplace(step.left.size());
    overlay_image_ = step.left.size();
    std_msgs::Header header = motions.header;
    header.frame_id = step.camera_frame_id;
    segmentation_.publish(
        cv_bridge::CvImage(header, "bgr8", overlay_->draw(step.left, step.estimate)).toImageMsg());
  } else {
    overlay_.reset();
  }
  return motions;
}

void Publisher::publishTf(const mvo::MotionArray& motions, const nav_msgs::Odometry& odometry,
                          const NodeOptions& options) {
  std::vector<geometry_msgs::TransformStamped> transforms;
  if (options.publish_tf) {
    const auto T = transform(odometry.header, odometry.child_frame_id, odometry.pose.pose);
    transforms.push_back(options.invert_tf ? inverted(T) : T);
  }
  if (options.publish_motion_tf)
    for (const mvo::Motion& m : motions.motions)
      if (!m.is_static && m.state != mvo::Motion::LOST)
        transforms.push_back(transform(motions.header, m.child_frame_id, m.pose.pose));
  tf_.sendTransform(transforms);
}

void Publisher::publishPath(const nav_msgs::Odometry& odometry, bool wanted) {
  geometry_msgs::PoseStamped pose;
  pose.header = odometry.header;
  pose.pose = odometry.pose.pose;
  path_.push_back(pose);
  if (path_.size() > path_length_) path_.pop_front();
  if (!wanted || path_publisher_.getNumSubscribers() == 0) return;
  nav_msgs::Path path;
  path.header = odometry.header;
  path.poses.assign(path_.begin(), path_.end());
  path_publisher_.publish(path);
}

}  // namespace mvo_ros
