// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/moving_objects.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>

#include "mvo/se3.hpp"

namespace mvo_ros {

namespace {

using RowMajor6d = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;
using Covariance = geometry_msgs::PoseWithCovariance::_covariance_type;

Covariance transformed(const mvo::Matrix6d& J, const Covariance& covariance) {
  const Eigen::Map<const RowMajor6d> in(covariance.data());
  const mvo::Matrix6d moved = J * in * J.transpose();
  Covariance out;
  Eigen::Map<RowMajor6d>(out.data()) = 0.5 * (moved + moved.transpose());
  return out;
}

Eigen::Vector3d vector(const geometry_msgs::Vector3& v) { return {v.x, v.y, v.z}; }

mvo::MovingObject objectOf(const mvo::Motion& motion, const Eigen::Vector3d& asked) {
  Eigen::Isometry3d T_odom_motion;
  tf2::fromMsg(motion.pose.pose, T_odom_motion);
  const Eigen::Matrix3d C = T_odom_motion.linear();
  Eigen::Vector3d center;
  tf2::fromMsg(motion.extent_center, center);
  const Eigen::Vector3d arm = center - T_odom_motion.translation();
  // The centre follows rotations about the motion's origin.
  mvo::Matrix6d J = mvo::Matrix6d::Identity();
  J.topRightCorner<3, 3>() = -mvo::hat(arm);
  mvo::Matrix6d to_odom = mvo::Matrix6d::Zero();
  to_odom.topLeftCorner<3, 3>() = C;
  to_odom.bottomRightCorner<3, 3>() = C;

  mvo::MovingObject out;
  out.id = motion.id;
  out.state = motion.state;
  out.extent = motion.extent;
  out.pose.pose = motion.pose.pose;
  out.pose.pose.position = motion.extent_center;
  out.pose.covariance = transformed(J, motion.pose.covariance);
  const Eigen::Vector3d angular = C * vector(motion.twist.twist.angular);
  const Eigen::Vector3d linear = C * vector(motion.twist.twist.linear) + angular.cross(arm);
  tf2::toMsg(linear, out.velocity.twist.linear);
  tf2::toMsg(angular, out.velocity.twist.angular);
  out.velocity.covariance = transformed(J * to_odom, motion.twist.covariance);
  const Eigen::Vector3d beyond =
      ((C.transpose() * (asked - center)).cwiseAbs() - 0.5 * vector(motion.extent)).cwiseMax(0);
  out.distance = beyond.norm();
  return out;
}

}  // namespace

std::vector<mvo::MovingObject> movingObjects(const mvo::MotionArray& motions,
                                             const Eigen::Vector3d& center, double radius) {
  std::vector<mvo::MovingObject> objects;
  for (const mvo::Motion& motion : motions.motions) {
    const bool here = motion.state == mvo::Motion::NEW || motion.state == mvo::Motion::TRACKED;
    if (motion.is_static || !here || !motion.moving) continue;
    const mvo::MovingObject object = objectOf(motion, center);
    if (radius <= 0 || object.distance <= radius) objects.push_back(object);
  }
  std::stable_sort(objects.begin(), objects.end(),
                   [](const auto& a, const auto& b) { return a.distance < b.distance; });
  return objects;
}

}  // namespace mvo_ros
