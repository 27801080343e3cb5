// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The robot's frames: a mount that comes late, TF the other way round, no TF at all.
#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "support/live_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::difference;
using mvo::test::eventually;
using mvo::test::isometry;
using mvo::test::kCameraFrame;

constexpr std::size_t kFrames = 6;

geometry_msgs::TransformStamped mount(const std::string& base, double x) {
  geometry_msgs::TransformStamped T;
  T.header.frame_id = base;
  T.child_frame_id = kCameraFrame;
  T.transform.translation.x = x;
  T.transform.rotation.x = -0.5;
  T.transform.rotation.y = 0.5;
  T.transform.rotation.z = -0.5;
  T.transform.rotation.w = 0.5;
  return T;
}

// TF from or to an odometry frame that was said so far.
std::vector<geometry_msgs::TransformStamped> transformsOf(
    const mvo::test::Recorder<tf2_msgs::TFMessage>& tf, const std::string& odom) {
  std::vector<geometry_msgs::TransformStamped> out;
  for (const auto& message : tf.all())
    for (const auto& T : message->transforms)
      if (T.header.frame_id == odom || T.child_frame_id == odom) out.push_back(T);
  return out;
}

TEST(LiveBaseFrame, MountsThatComeLateAndTfTheOtherWayRound) {
  const auto recording = mvo::test::recordBlocks(2 * kFrames);
  tf2_ros::StaticTransformBroadcaster broadcaster;
  // The chain is (later) base_late -> base_early -> camera.
  broadcaster.sendTransform(mount("base_early", 0.2));
  mvo::test::Recorder<tf2_msgs::TFMessage> tf("/tf");
  const auto topics = mvo::test::CameraTopics::stereo();
  mvo::test::LiveRun newest("/newest", topics);
  mvo::test::LiveRun all("/all", topics);
  mvo::test::LiveRun inverted("/inverted", topics);
  mvo::test::LiveRun silent("/silent", topics);
  ASSERT_TRUE(topics.connected(4));
  for (const auto* live : {&newest, &all, &inverted, &silent}) ASSERT_TRUE(live->connected());
  ASSERT_TRUE(eventually([&tf] { return tf.connected(); }));

  std::size_t k = 0;
  const auto publish = [&] {
    mvo::test::CameraSet set = mvo::test::stereoSet(recording, std::min(k, 2 * kFrames - 1));
    stamp(set, ros::Time(400) + ros::Duration(static_cast<double>(k++) / 15));
    inverted.step(set);
    EXPECT_TRUE(eventually([&] { return silent.motions.size() >= k; }));
  };
  while (k < kFrames) publish();

  // The mount is missing: said in log and diagnostics, nothing comes out.
  const std::vector<std::string> complaint = {"no transform", kCameraFrame, "base_late"};
  for (const auto* live : {&newest, &all})
    EXPECT_TRUE(eventually([&] {
      return live->log.said(complaint) && live->diagnostics.said(complaint);
    })) << live->diagnostics.message();
  EXPECT_EQ(newest.motions.size(), 0U);
  EXPECT_EQ(all.motions.size(), 0U);

  // It comes: with queue all no frame is missing.
  geometry_msgs::TransformStamped late;
  late.header.frame_id = "base_late";
  late.child_frame_id = "base_early";
  late.transform.rotation.w = 1;
  late.transform.translation.z = -0.4;
  broadcaster.sendTransform(late);
  EXPECT_TRUE(eventually([&] { return all.motions.size() == kFrames; }));
  // With queue newest the next frame begins.
  EXPECT_TRUE(eventually([&] {
    publish();
    return newest.motions.size() > 0;
  }));
  EXPECT_TRUE(eventually([&] { return all.motions.size() == k; }));
  EXPECT_EQ(all.odometry.last()->child_frame_id, "base_late");
  EXPECT_LT(difference(isometry(all.odometry.all()[0]->pose.pose), Eigen::Isometry3d::Identity()),
            1e-9);

  // TF with the base as the parent; odometry as ever.
  const auto odometry = inverted.odometry.last();
  EXPECT_EQ(odometry->header.frame_id, "odom_inverted");
  EXPECT_EQ(odometry->child_frame_id, "base_early");
  EXPECT_GT(difference(isometry(odometry->pose.pose), Eigen::Isometry3d::Identity()), 1e-3);
  bool found = false;
  ASSERT_TRUE(eventually([&] {
    for (const auto& T : transformsOf(tf, "odom_inverted"))
      if (T.header.stamp == odometry->header.stamp && T.child_frame_id == "odom_inverted") {
        EXPECT_EQ(T.header.frame_id, "base_early");
        EXPECT_LT(difference(tf2::transformToEigen(T).inverse(), isometry(odometry->pose.pose)),
                  1e-9);
        found = true;
      }
    return found;
  }));
  for (const auto& T : transformsOf(tf, "odom_inverted")) {
    EXPECT_NE(T.child_frame_id, "base_early");
    if (T.header.frame_id == "odom_inverted") {
      EXPECT_EQ(T.child_frame_id.rfind("body_", 0), 0U);
    }
  }

  EXPECT_TRUE(transformsOf(tf, "odom_silent").empty());
  EXPECT_FALSE(silent.motions.last()->lost);
}

}  // namespace
}  // namespace mvo_ros
