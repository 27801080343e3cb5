// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A live node with a camera in front of it: what goes in, one set at a time, and what comes out.
#pragma once

#include <mvo/MotionArray.h>
#include <nav_msgs/Odometry.h>
#include <tf2_eigen/tf2_eigen.h>

#include <Eigen/Geometry>

#include "support/recorder.hpp"
#include "support/simulated_camera.hpp"

namespace mvo::test {

inline Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d T;
  tf2::fromMsg(pose, T);
  return T;
}

/// Distance [m] and angle [rad] of two poses, the larger number of the two.
inline double difference(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
  const Eigen::Isometry3d d = a.inverse() * b;
  return std::max(d.translation().norm(), Eigen::AngleAxisd(d.linear()).angle());
}

/// Feeds a node set by set: the next goes out when the last one's motions have come in.
class LiveRun {
 public:
  /// The node's name, and how its camera is reached.
  LiveRun(const std::string& node, CameraTopics topics)
      : camera(std::move(topics)),
        odometry(node + "/odometry"),
        motions(node + "/motions"),
        diagnostics(node.substr(1)),
        log(node) {}

  /// Whether the node is up and listens.
  bool connected() const {
    return camera.connected() &&
           eventually([&] { return odometry.connected() && motions.connected(); });
  }
  /// Publishes a set and waits for its motions and odometry, known by their stamps: those of sets
  /// published before may still be under way, and a stamp may come again. Null if they did not come
  /// in time.
  mvo::MotionArrayConstPtr step(const CameraSet& set, double seconds = kPatience) {
    const ros::Time stamp = set.left.header.stamp;
    const std::size_t before = motions.size();
    const std::size_t before_odometry = odometry.size();
    camera.publish(set);
    mvo::MotionArrayConstPtr array;
    eventually(
        [&] {
          array =
              odometry.stamped(stamp, before_odometry) ? motions.stamped(stamp, before) : nullptr;
          return array != nullptr;
        },
        seconds);
    return array;
  }

  CameraTopics camera;
  Recorder<nav_msgs::Odometry> odometry;
  Recorder<mvo::MotionArray> motions;
  DiagnosticsRecorder diagnostics;
  LogRecorder log;
};

/// How many bodies have a pose.
inline std::size_t bodies(const mvo::MotionArray& array) {
  std::size_t count = 0;
  for (const mvo::Motion& m : array.motions)
    if (!m.is_static && (m.state == mvo::Motion::NEW || m.state == mvo::Motion::TRACKED)) ++count;
  return count;
}

/// The camera's pose without a jump: between neighbours of two series, as long as the world is the
/// same, the odometry moves less than the limit.
inline void expectNoJump(const std::vector<mvo::MotionArrayConstPtr>& motions,
                         const std::vector<nav_msgs::OdometryConstPtr>& odometry, double limit) {
  ASSERT_EQ(motions.size(), odometry.size());
  for (std::size_t i = 1; i < motions.size(); ++i) {
    ASSERT_EQ(motions[i]->header.stamp, odometry[i]->header.stamp);
    if (motions[i]->resets != motions[i - 1]->resets) continue;
    EXPECT_LT(difference(isometry(odometry[i - 1]->pose.pose), isometry(odometry[i]->pose.pose)),
              limit)
        << "at " << motions[i]->header.stamp;
  }
}

}  // namespace mvo::test
