// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates as messages in the odometry frame.
#pragma once

#include <mvo/MotionArray.h>
#include <nav_msgs/Odometry.h>

#include <map>
#include <string>
#include <utility>

#include "ros/live/odometry_session.hpp"
#include "ros/sensor/mount.hpp"

namespace mvo_ros {

/// What the variances are of what is not known.
constexpr double kUnknownVariance = 9999;

/// Turns steps into MotionArrays. Remembers the last message of each motion, for those that rest or
/// were lost.
class MotionMessages {
 public:
  explicit MotionMessages(std::string motion_frame_prefix)
      : prefix_(std::move(motion_frame_prefix)) {}

  mvo::MotionArray motions(const Step& step, const Mount& mount);

 private:
  mvo::Motion motion(const mvo::MotionEstimate& estimate, const Step& step,
                     const Mount& mount) const;
  mvo::Motion departed(const mvo::DepartedMotion& estimate, const Step& step,
                       const Mount& mount) const;

  std::string prefix_;
  std::map<mvo::LabelId, mvo::Motion> last_;
};

/// The base frame's odometry: the static world's motion, or if the camera is lost where it is
/// taken to be with unknown covariance and no twist.
nav_msgs::Odometry odometryMessage(const mvo::MotionArray& motions, const Step& step,
                                   const Mount& mount);

}  // namespace mvo_ros
