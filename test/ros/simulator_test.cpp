// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The simulated camera as its subscribers meet it, and its options.
#include <cv_bridge/cv_bridge.h>
#include <geometry_msgs/PoseArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/transform_listener.h>

#include <algorithm>

#include "mvo/sim.hpp"
#include "ros/sensor/camera_from_info.hpp"
#include "ros/simulator/simulator_options.hpp"
#include "support/recorder.hpp"

namespace {

using mvo::test::eventually;
using mvo::test::Recorder;
using sensor_msgs::CameraInfo;
using sensor_msgs::Image;

Eigen::Isometry3d isometry(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d T;
  tf2::fromMsg(pose, T);
  return T;
}

mvo::sim::Scene sceneOf(const std::string& name, double rate, bool rgbd) {
  mvo::sim::SceneOptions options;
  options.width = 160;
  options.height = 120;
  options.rate_hz = rate;
  options.rgbd = rgbd;
  return mvo::sim::makeScene(name, 1, options);
}

TEST(StereoSimulator, IsADriverWithTheTruthBesideIt) {
  const Recorder<nav_msgs::Odometry> odometry("/stereo/simulator/truth/odometry");
  const Recorder<geometry_msgs::PoseArray> bodies("/stereo/simulator/truth/bodies");
  ASSERT_TRUE(eventually([&] { return odometry.connected() && bodies.connected(); }));
  // It waits for all four, so the first message is the first frame.
  const Recorder<CameraInfo> left_info("/stereo/left/camera_info");
  const Recorder<CameraInfo> right_info("/stereo/right/camera_info");
  const Recorder<Image> left("/stereo/left/image_rect");
  const Recorder<Image> right("/stereo/right/image_rect");
  constexpr std::size_t kFrames = 30;  // twice to and fro
  ASSERT_TRUE(eventually([&] {
    return std::min({odometry.size(), bodies.size(), left_info.size(), right_info.size(),
                     left.size(), right.size()}) >= kFrames;
  }));

  const auto scene = sceneOf("blocks", 30, false);
  const auto camera = mvo_ros::stereoCamera(*left_info.last(), *right_info.last(), "l", "r");
  EXPECT_NEAR(camera.fu, scene.camera.fu, 1e-9);
  EXPECT_NEAR(camera.baseline, scene.camera.baseline, 1e-9);

  tf2_ros::Buffer tf;
  const tf2_ros::TransformListener listener(tf);
  const auto mount = [&](const std::string& frame) {
    return tf2::transformToEigen(
        tf.lookupTransform("base_link", frame, ros::Time(0), ros::Duration(20)));
  };
  const Eigen::Isometry3d T_base_left = mount("camera_left_optical");
  const Eigen::Isometry3d T_base_right = mount("camera_right_optical");
  EXPECT_TRUE(T_base_left.linear().col(2).isApprox(Eigen::Vector3d::UnitX()));   // forward
  EXPECT_TRUE(T_base_left.linear().col(1).isApprox(-Eigen::Vector3d::UnitZ()));  // down
  EXPECT_TRUE((T_base_left.inverse() * T_base_right)
                  .isApprox(Eigen::Isometry3d(Eigen::Translation3d(camera.baseline, 0, 0))));

  const auto lefts = left.all();
  const auto rights = right.all();
  const auto truths = odometry.all();
  const auto body_truths = bodies.all();
  const Eigen::Isometry3d T_world_odom =
      scene.T_world_camera(0) * T_base_left.inverse();  // at the first frame
  for (std::size_t k = 0; k < kFrames; ++k) {
    const int phase = static_cast<int>(k % 14);
    const int shown = phase < 8 ? phase : 14 - phase;
    ASSERT_EQ(lefts[k]->header.stamp, rights[k]->header.stamp);
    ASSERT_EQ(lefts[k]->header.stamp, truths[k]->header.stamp);
    ASSERT_EQ(lefts[k]->header.stamp, body_truths[k]->header.stamp);
    ASSERT_EQ(lefts[k]->header.frame_id, "camera_left_optical");
    ASSERT_EQ(rights[k]->header.frame_id, "camera_right_optical");
    ASSERT_EQ(lefts[k]->encoding, "mono8");
    if (k > 0) {
      ASSERT_GT(lefts[k]->header.stamp, lefts[k - 1]->header.stamp);
    }
    const auto frame = mvo::sim::render(scene, shown);
    EXPECT_EQ(cv::norm(cv_bridge::toCvShare(lefts[k])->image, frame.left, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(cv_bridge::toCvShare(rights[k])->image, frame.right, cv::NORM_INF), 0);
    const Eigen::Isometry3d T_odom_base = isometry(truths[k]->pose.pose);
    if (k == 0) {
      EXPECT_TRUE(T_odom_base.isApprox(Eigen::Isometry3d::Identity()));
    }
    EXPECT_TRUE((T_world_odom * T_odom_base * T_base_left).isApprox(frame.T_world_camera, 1e-9));
    ASSERT_EQ(body_truths[k]->poses.size(), 4U);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_TRUE((T_world_odom * isometry(body_truths[k]->poses[i]))
                      .isApprox(frame.T_world_bodies[i], 1e-9));
  }
  EXPECT_EQ(truths[3]->header.frame_id, "odom");
  EXPECT_EQ(truths[3]->child_frame_id, "base_link");
  const Eigen::Isometry3d step =
      isometry(truths[2]->pose.pose).inverse() * isometry(truths[3]->pose.pose);
  EXPECT_NEAR(truths[3]->twist.twist.linear.x, 30 * step.translation().x(), 1e-6);
}

TEST(RgbdSimulator, SendsColourAndDepthAndEnds) {
  const Recorder<geometry_msgs::PoseArray> bodies("/camera/simulator/truth/bodies");
  ASSERT_TRUE(eventually([&] { return bodies.connected(); }));
  const Recorder<CameraInfo> info("/camera/rgb/camera_info");
  const Recorder<Image> color("/camera/rgb/image_rect_color");
  const Recorder<Image> depth("/camera/depth_registered/image_rect");
  ASSERT_TRUE(eventually([&] { return bodies.size() == 6 && color.size() == 6; }));
  ASSERT_TRUE(eventually([&] { return !color.connected(); })) << "the node did not end";
  ASSERT_EQ(depth.size(), 6U);
  const auto scene = sceneOf("spin", 10, true);
  const auto frame = mvo::sim::toSequenceFrame(mvo::sim::render(scene, 5));
  EXPECT_EQ(color.last()->encoding, "bgr8");
  EXPECT_EQ(depth.last()->encoding, "16UC1");
  EXPECT_EQ(color.last()->header.frame_id, "camera_rgb_optical");
  EXPECT_EQ(depth.last()->header.stamp, color.last()->header.stamp);
  EXPECT_EQ(cv::norm(cv_bridge::toCvShare(color.last())->image, frame.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(cv_bridge::toCvShare(depth.last())->image, frame.right, cv::NORM_INF), 0);
  EXPECT_EQ(bodies.last()->poses.size(), 1U);
  EXPECT_NEAR(info.last()->K[0], scene.camera.fu, 1e-9);
}

std::string problemOf(const std::string& key, const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue tree;
  tree[key] = value;
  try {
    mvo_ros::simulatorOptions(tree);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(SimulatorOptions, WrongOnesAreNamedWithTheirRange) {
  using mvo::test::says;
  EXPECT_EQ(problemOf("scene", "cars"), "");
  EXPECT_TRUE(says(problemOf("scene", "moon"), {"scene", "'moon'", "blocks", "cars"}));
  EXPECT_TRUE(says(problemOf("sensor", "lidar"), {"sensor", "'lidar'", "stereo", "rgbd"}));
  EXPECT_TRUE(says(problemOf("rate", 0), {"rate", "'0'", "0.1", "1000", "Hz"}));
  EXPECT_TRUE(says(problemOf("width", 10), {"width", "'10'", "64", "4096"}));
  EXPECT_TRUE(says(problemOf("frames", -1), {"frames", "'-1'", "0", "1000000"}));
  EXPECT_TRUE(says(problemOf("prerender", 1.5), {"prerender", "'1.5'", "whole"}));
  EXPECT_TRUE(says(problemOf("base_frame", ""), {"base_frame"}));
  EXPECT_TRUE(says(problemOf("right_yaw", 9), {"right_yaw", "'9'", "-5", "5", "deg"}));
  EXPECT_TRUE(says(problemOf("speed", 1), {"'speed'", "scene", "rate"}));
}

TEST(SimulatorOptions, SceneBringsItsSizeAndRate) {
  XmlRpc::XmlRpcValue tree;
  tree["scene"] = "street";
  tree["height"] = 300;
  const auto options = mvo_ros::simulatorOptions(tree);
  EXPECT_EQ(options.scene, "street");
  EXPECT_EQ(options.camera.width, 1241);
  EXPECT_EQ(options.camera.height, 300);
  EXPECT_EQ(options.camera.rate_hz, 10);
}

TEST(SimulatorOptions, ImperfectionsAreThoseOfTheTool) {
  XmlRpc::XmlRpcValue tree;
  tree["right_yaw"] = 0.05;
  tree["jpeg"] = 80;
  tree["gain"] = 0.7;
  const auto options = mvo_ros::simulatorOptions(tree);
  EXPECT_EQ(options.camera.imperfections.right_yaw, 0.05);
  EXPECT_EQ(options.camera.imperfections.jpeg, 80);
  EXPECT_EQ(options.camera.gain, 0.7);
  tree["sensor"] = "rgbd";
  EXPECT_THROW(mvo_ros::simulatorOptions(tree), std::invalid_argument);
}

}  // namespace
