// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/motion_messages.hpp"

#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>

#include "mvo/se3.hpp"
#include "trajectories/uncertainty.hpp"

namespace mvo_ros {

namespace {

using Covariance = geometry_msgs::PoseWithCovariance::_covariance_type;

Covariance asCovariance(const mvo::Matrix6d& matrix) {
  Covariance out;
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(out.data()) =
      0.5 * (matrix + matrix.transpose());
  return out;
}

Covariance unknown() { return asCovariance(kUnknownVariance * mvo::Matrix6d::Identity()); }

geometry_msgs::Twist asTwist(const mvo::Vector6d& xi) {
  geometry_msgs::Twist twist;
  tf2::toMsg(Eigen::Vector3d(xi.head<3>()), twist.linear);
  tf2::toMsg(Eigen::Vector3d(xi.tail<3>()), twist.angular);
  return twist;
}

const mvo::MotionEstimate* cameraOf(const Step& step) {
  return step.estimate.valid ? &step.estimate.motions.front() : nullptr;
}

// A motion's frame in the camera: for the static world's motion the base frame, fixed there.
Eigen::Isometry3d inCamera(mvo::LabelId id, const Eigen::Isometry3d& T_ck_motion,
                           const Mount& mount) {
  return id == mvo::kStatic ? mount.T_camera_base : T_ck_motion;
}

geometry_msgs::PoseStamped stamped(const Eigen::Isometry3d& T, const std::string& frame_id,
                                   const ros::Time& stamp) {
  geometry_msgs::PoseStamped out;
  out.header.frame_id = frame_id;
  out.header.stamp = stamp;
  out.pose = tf2::toMsg(T);
  return out;
}

void setTrajectories(const Step& step, const Mount& mount, mvo::Motion& out) {
  for (const mvo::SmoothedPose& pose : step.estimate.smoothed) {
    const auto stamp = step.stamps.find(pose.frame);
    if (pose.id != out.id || stamp == step.stamps.end()) continue;
    const bool is_static = pose.id == mvo::kStatic;
    const Eigen::Isometry3d T_odom_motion =
        mount.T_odom_world * pose.T_world_motion *
        (is_static ? mount.T_camera_base : Eigen::Isometry3d::Identity());
    const Eigen::Isometry3d T_ck_motion =
        is_static ? Eigen::Isometry3d(pose.T_ck_motion * mount.T_odom_world.inverse())
                  : pose.T_ck_motion;
    out.trajectory.push_back(stamped(T_odom_motion, mount.odom_frame, stamp->second));
    out.egocentric_trajectory.push_back(stamped(T_ck_motion, mount.camera_frame, stamp->second));
  }
}

// The twist over the last step. Both covariances add up where the camera's motion is subtracted.
void setStep(const mvo::MotionEstimate& estimate, const Step& step, const Mount& mount,
             mvo::Motion& out) {
  const mvo::MotionEstimate& camera = *cameraOf(step);
  out.motion_since_last.orientation.w = 1;
  out.twist.covariance = unknown();
  if (!estimate.T_ckm1_motion || !camera.T_ckm1_motion || !step.period || *step.period <= 0) return;
  const bool is_static = estimate.id == mvo::kStatic;
  // T_ck_ckm1 of the static world.
  const Eigen::Isometry3d T_ck_ckm1 = camera.T_ck_motion * camera.T_ckm1_motion->inverse();
  const Eigen::Isometry3d T_ck_x = inCamera(estimate.id, estimate.T_ck_motion, mount);
  const Eigen::Isometry3d T_ckm1_x = is_static ? mount.T_camera_base : *estimate.T_ckm1_motion;
  const Eigen::Isometry3d T_xkm1_xk = (T_ck_ckm1 * T_ckm1_x).inverse() * T_ck_x;
  const mvo::Matrix6d eta = is_static
                                ? camera.step_covariance
                                : mvo::Matrix6d(camera.step_covariance + estimate.step_covariance);
  const double rate = 1.0 / *step.period;
  out.motion_since_last = tf2::toMsg(T_xkm1_xk);
  out.twist.twist = asTwist(rate * mvo::log(T_xkm1_xk));
  out.twist.covariance = asCovariance(rate * rate * mvo::stepCovariance(T_ck_x, eta));
}

}  // namespace

mvo::Motion MotionMessages::motion(const mvo::MotionEstimate& e, const Step& step,
                                   const Mount& mount) const {
  const bool is_static = e.id == mvo::kStatic;
  const mvo::Matrix6d& of_camera = cameraOf(step)->pose_covariance;
  const Eigen::Isometry3d T_odom_camera = mount.T_odom_world * step.T_world_camera;
  const Eigen::Isometry3d T_camera_x = inCamera(e.id, e.T_ck_motion, mount);
  const Eigen::Isometry3d T_odom_x = T_odom_camera * T_camera_x;

  mvo::Motion out;
  out.id = e.id;
  out.child_frame_id = is_static ? mount.base_frame : prefix_ + std::to_string(e.id);
  out.state = e.state == mvo::MotionState::kNew ? mvo::Motion::NEW : mvo::Motion::TRACKED;
  out.is_static = is_static;
  out.moving = e.significance > mvo::kRestQuantile;
  const auto known = last_.find(e.id);
  out.first_stamp = known == last_.end() ? step.stamp : known->second.first_stamp;
  out.last_stamp = step.stamp;
  out.pose.pose = tf2::toMsg(T_odom_x);
  out.pose.covariance = asCovariance(
      mvo::poseCovariance(T_odom_camera, T_camera_x,
                          is_static ? of_camera : mvo::Matrix6d(of_camera + e.pose_covariance)));
  setStep(e, step, mount, out);
  const Eigen::Isometry3d T_camera_motion =
      is_static ? T_odom_camera.inverse() : e.T_ck_motion;  // id 0: the odometry frame
  out.egocentric.pose = tf2::toMsg(T_camera_motion);
  out.egocentric.covariance = asCovariance(
      mvo::poseCovariance(Eigen::Isometry3d::Identity(), T_camera_motion, e.pose_covariance));
  out.centroid = tf2::toMsg(Eigen::Vector3d(mount.T_odom_world * e.centroid_world));
  if (!is_static && !e.extent_motion.isEmpty()) {
    out.extent_center = tf2::toMsg(Eigen::Vector3d(T_odom_x * e.extent_motion.center()));
    tf2::toMsg(Eigen::Vector3d(e.extent_motion.sizes()), out.extent);
  }
  out.support = static_cast<std::uint32_t>(e.support);
  out.visible = static_cast<std::uint32_t>(e.visible);
  out.rms_residual = e.rms;
  out.converged = e.converged;
  setTrajectories(step, mount, out);
  return out;
}

mvo::Motion MotionMessages::departed(const mvo::DepartedMotion& e, const Step& step,
                                     const Mount& mount) const {
  const auto known = last_.find(e.id);
  mvo::Motion out = known == last_.end() ? mvo::Motion() : known->second;
  const bool stopped = e.state == mvo::MotionState::kStopped;
  out.id = e.id;
  out.child_frame_id = prefix_ + std::to_string(e.id);
  out.state = stopped ? mvo::Motion::STOPPED : mvo::Motion::LOST;
  out.moving = false;
  const Eigen::Isometry3d T_odom_motion = mount.T_odom_world * e.T_world_motion;
  out.pose.pose = tf2::toMsg(T_odom_motion);
  out.motion_since_last = tf2::toMsg(Eigen::Isometry3d::Identity());
  out.twist.twist = geometry_msgs::Twist();
  const Eigen::Isometry3d T_camera_motion =
      (mount.T_odom_world * step.T_world_camera).inverse() * T_odom_motion;
  out.egocentric.pose = tf2::toMsg(T_camera_motion);
  if (!stopped) {
    out.pose.covariance = out.egocentric.covariance = unknown();
    out.twist.covariance = unknown();
  }
  out.support = out.visible = 0;
  out.converged = false;
  out.trajectory.clear();
  out.egocentric_trajectory.clear();
  return out;
}

mvo::MotionArray MotionMessages::motions(const Step& step, const Mount& mount) {
  if (step.restarted) last_.clear();
  mvo::MotionArray out;
  out.header.stamp = step.stamp;
  out.header.frame_id = mount.odom_frame;
  out.camera_frame_id = mount.camera_frame;
  out.static_id = mvo::kStatic;
  out.window_begin = step.stamps.empty() ? step.stamp : step.stamps.begin()->second;
  out.window_end = step.stamp;
  out.lost = !step.estimate.valid;
  out.converged = step.estimate.converged;
  out.cut_short = step.estimate.cut_short.text();
  out.world_changes = static_cast<std::uint32_t>(step.estimate.world_changes);
  out.resets = step.resets;
  if (step.estimate.valid)
    for (const mvo::MotionEstimate& e : step.estimate.motions)
      out.motions.push_back(motion(e, step, mount));
  for (const mvo::Motion& m : out.motions) last_[m.id] = m;
  for (const mvo::DepartedMotion& e : step.estimate.departed)
    if (e.id != mvo::kStatic) out.motions.push_back(departed(e, step, mount));
  // An id may return as long as its frames are in the window, and while it rests.
  for (auto it = last_.begin(); it != last_.end();) {
    const bool here = std::any_of(out.motions.begin(), out.motions.end(),
                                  [&](const mvo::Motion& m) { return m.id == it->first; });
    it = !here && it->second.last_stamp < out.window_begin ? last_.erase(it) : std::next(it);
  }
  std::stable_sort(out.motions.begin(), out.motions.end(),
                   [](const mvo::Motion& a, const mvo::Motion& b) { return a.id < b.id; });
  return out;
}

nav_msgs::Odometry odometryMessage(const mvo::MotionArray& motions, const Step& step,
                                   const Mount& mount) {
  nav_msgs::Odometry out;
  out.header = motions.header;
  out.child_frame_id = mount.base_frame;
  if (!motions.lost && !motions.motions.empty()) {
    out.pose = motions.motions.front().pose;
    out.twist = motions.motions.front().twist;
    return out;
  }
  out.pose.pose =
      tf2::toMsg(Eigen::Isometry3d(mount.T_odom_world * step.T_world_camera * mount.T_camera_base));
  out.pose.covariance = out.twist.covariance = unknown();
  return out;
}

}  // namespace mvo_ros
