// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/motion_messages.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_eigen/tf2_eigen.h>

#include <Eigen/Eigenvalues>

#include "edges/motion_color.hpp"
#include "mvo/se3.hpp"
#include "ros/live/cloud_message.hpp"
#include "ros/live/moving_objects.hpp"

namespace mvo_ros {
namespace {

constexpr double kPeriod = 0.1;
constexpr int kBody = 3;

mvo::Vector6d twist(double x, double y, double z, double rx, double ry, double rz) {
  return (mvo::Vector6d() << x, y, z, rx, ry, rz).finished();
}

// A camera that moves forward and turns, a body that moves to the right, in the world's axes
// (optical).
Eigen::Isometry3d cameraAt(int k) { return mvo::exp(k * twist(0, 0, 0.10, 0, 0.02, 0)); }
Eigen::Isometry3d bodyAt(int k) {
  return Eigen::Translation3d(-1, 0.5, 4) * mvo::exp(k * twist(0.05, 0, 0, 0, 0, 0.03));
}

mvo::Matrix6d someCovariance(double sigma) {
  mvo::Matrix6d A;
  for (int i = 0; i < 36; ++i) A(i / 6, i % 6) = std::sin(1.7 * i) + (i % 7 == 0 ? 2 : 0);
  return sigma * sigma * A * A.transpose();
}

// The step of frame k with a window of four frames.
Step stepAt(int k) {
  Step step;
  mvo::MultimotionEstimate& e = step.estimate;
  e.frame = k;
  e.window_begin = std::max(0, k - 3);
  e.valid = true;
  e.converged = true;
  for (mvo::FrameId f = e.window_begin; f <= k; ++f) {
    step.stamps[f] = ros::Time(100 + kPeriod * static_cast<double>(f));
    const auto i = static_cast<int>(f);
    const Eigen::Isometry3d T_ci_world = cameraAt(i).inverse();
    e.smoothed.push_back({mvo::kStatic, f, cameraAt(i), T_ci_world});
    e.smoothed.push_back({kBody, f, bodyAt(i), T_ci_world * bodyAt(i)});
  }
  mvo::MotionEstimate camera;
  camera.T_world_motion = cameraAt(k);
  camera.T_ck_motion = cameraAt(k).inverse();
  if (k > 0) camera.T_ckm1_motion = cameraAt(k - 1).inverse();
  camera.covariance = camera.pose_covariance = someCovariance(1e-3);
  camera.step_covariance = someCovariance(5e-4);
  mvo::MotionEstimate body = camera;
  body.id = kBody;
  body.T_world_motion = bodyAt(k);
  body.T_ck_motion = cameraAt(k).inverse() * bodyAt(k);
  if (k > 0) body.T_ckm1_motion = cameraAt(k - 1).inverse() * bodyAt(k - 1);
  body.covariance = body.pose_covariance = someCovariance(3e-3);
  body.state = k == 0 ? mvo::MotionState::kNew : mvo::MotionState::kTracked;
  body.significance = 100;
  body.support = 40;
  body.visible = 30;
  body.centroid_world = bodyAt(k) * Eigen::Vector3d(0.1, 0, 0);
  body.extent_motion =
      Eigen::AlignedBox3d(Eigen::Vector3d(-0.1, -0.2, -0.3), Eigen::Vector3d(0.3, 0.2, 0.3));
  e.motions = {camera, body};
  step.camera = {500, 500, 320, 240, 0.2, 640, 480};
  step.camera_frame_id = "cam";
  step.stamp = step.stamps[k];
  step.T_world_camera = cameraAt(k);
  if (k > 0) step.period = kPeriod;
  return step;
}

Mount mountOnRobot() {
  Eigen::Isometry3d T_base_camera = mountAlone("odom", "cam").T_odom_world;
  T_base_camera.translation() << 0.3, 0.1, 1.2;
  return mountOn("odom", "base_link", "cam", T_base_camera);
}

Eigen::Isometry3d eigen(const geometry_msgs::Pose& pose) {
  Eigen::Isometry3d T;
  tf2::fromMsg(pose, T);
  return T;
}

Eigen::Matrix<double, 6, 6, Eigen::RowMajor> matrix(
    const geometry_msgs::PoseWithCovariance::_covariance_type& c) {
  return Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(c.data());
}

void expectCovariance(const geometry_msgs::PoseWithCovariance::_covariance_type& c) {
  const mvo::Matrix6d M = matrix(c);
  EXPECT_EQ(M, M.transpose());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<mvo::Matrix6d>(M).eigenvalues().minCoeff(), 0);
}

TEST(MotionMessages, PosesAreInTheOdometryFrame) {
  MotionMessages messages("motion_");
  const Mount mount = mountOnRobot();
  const mvo::MotionArray array = messages.motions(stepAt(5), mount);
  EXPECT_EQ(array.header.frame_id, "odom");
  EXPECT_EQ(array.header.stamp, ros::Time(100.5));
  EXPECT_EQ(array.window_begin, ros::Time(100.2));
  EXPECT_EQ(array.camera_frame_id, "cam");
  ASSERT_EQ(array.motions.size(), 2U);
  const mvo::Motion& camera = array.motions[0];
  EXPECT_TRUE(camera.is_static);
  EXPECT_EQ(camera.child_frame_id, "base_link");
  EXPECT_TRUE(eigen(camera.pose.pose)
                  .isApprox(mount.T_odom_world * cameraAt(5) * mount.T_camera_base, 1e-9));
  const mvo::Motion& body = array.motions[1];
  EXPECT_EQ(body.child_frame_id, "motion_3");
  EXPECT_TRUE(body.moving);
  EXPECT_TRUE(eigen(body.pose.pose).isApprox(mount.T_odom_world * bodyAt(5), 1e-9));
  EXPECT_TRUE(eigen(body.egocentric.pose).isApprox(cameraAt(5).inverse() * bodyAt(5), 1e-9));
  ASSERT_EQ(body.trajectory.size(), 4U);
  ASSERT_EQ(body.egocentric_trajectory.size(), 4U);
  EXPECT_EQ(body.trajectory[0].header.stamp, array.window_begin);
  EXPECT_TRUE(eigen(body.trajectory[1].pose).isApprox(mount.T_odom_world * bodyAt(3), 1e-9));
  EXPECT_TRUE(eigen(body.trajectory.back().pose).isApprox(eigen(body.pose.pose), 1e-9));
  // The odometry frame in the camera, which is where the world's frame is through the mount.
  EXPECT_TRUE(
      eigen(camera.egocentric.pose).isApprox((mount.T_odom_world * cameraAt(5)).inverse(), 1e-9));
  EXPECT_TRUE(eigen(camera.egocentric_trajectory.back().pose)
                  .isApprox(eigen(camera.egocentric.pose), 1e-9));
}

TEST(MotionMessages, TwistsAreStepsOverTimeInTheMotionsOwnAxes) {
  MotionMessages messages("motion_");
  const Mount mount = mountOnRobot();
  const mvo::MotionArray before = messages.motions(stepAt(4), mount);
  const mvo::MotionArray now = messages.motions(stepAt(5), mount);
  for (std::size_t i = 0; i < 2; ++i) {
    const Eigen::Isometry3d T_last_now =
        eigen(before.motions[i].pose.pose).inverse() * eigen(now.motions[i].pose.pose);
    const mvo::Motion& m = now.motions[i];
    EXPECT_TRUE(eigen(m.motion_since_last).isApprox(T_last_now, 1e-9));
    const mvo::Vector6d expected = mvo::log(T_last_now) / kPeriod;
    const auto& t = m.twist.twist;
    EXPECT_LT((twist(t.linear.x, t.linear.y, t.linear.z, t.angular.x, t.angular.y, t.angular.z) -
               expected)
                  .norm(),
              1e-9);
    expectCovariance(m.twist.covariance);
    expectCovariance(m.pose.covariance);
    expectCovariance(m.egocentric.covariance);
  }
  // The base moves forward: REP 103.
  EXPECT_NEAR(now.motions[0].twist.twist.linear.x, 1.0, 0.03);
  // A body's world covariance contains the camera's.
  EXPECT_GT(matrix(now.motions[1].pose.covariance).trace(),
            matrix(now.motions[0].pose.covariance).trace());
}

TEST(MotionMessages, TheFirstFrameHasNoTwist) {
  MotionMessages messages("motion_");
  const mvo::MotionArray array = messages.motions(stepAt(0), mountOnRobot());
  EXPECT_EQ(array.motions[1].state, mvo::Motion::NEW);
  EXPECT_EQ(array.motions[0].twist.twist.linear.x, 0);
  EXPECT_EQ(array.motions[0].twist.covariance[0], kUnknownVariance);
}

TEST(MotionMessages, ARestingBodyStaysWhereItIsAndALostOneIsUncertain) {
  MotionMessages messages("motion_");
  const Mount mount = mountOnRobot();
  messages.motions(stepAt(5), mount);
  Step step = stepAt(6);
  step.estimate.motions.pop_back();
  step.estimate.departed = {{kBody, mvo::MotionState::kStopped, bodyAt(5), 0, 5}};
  mvo::MotionArray array = messages.motions(step, mount);
  ASSERT_EQ(array.motions.size(), 2U);
  const mvo::Motion stopped = array.motions[1];
  EXPECT_EQ(stopped.state, mvo::Motion::STOPPED);
  EXPECT_FALSE(stopped.moving);
  EXPECT_EQ(stopped.last_stamp, ros::Time(100.5));
  EXPECT_EQ(stopped.twist.twist.linear.x, 0);
  EXPECT_TRUE(eigen(stopped.pose.pose).isApprox(mount.T_odom_world * bodyAt(5), 1e-9));
  EXPECT_TRUE(eigen(stopped.egocentric.pose).isApprox(cameraAt(6).inverse() * bodyAt(5), 1e-9));
  EXPECT_GT(stopped.extent.x, 0);

  step.estimate.departed[0].state = mvo::MotionState::kLost;
  array = messages.motions(step, mount);
  EXPECT_EQ(array.motions[1].state, mvo::Motion::LOST);
  EXPECT_EQ(array.motions[1].pose.covariance[0], kUnknownVariance);
}

TEST(OdometryMessage, IsWhereTheCameraIsTakenToBeWhenLost) {
  MotionMessages messages("motion_");
  const Mount mount = mountOnRobot();
  Step step = stepAt(5);
  const nav_msgs::Odometry good = odometryMessage(messages.motions(step, mount), step, mount);
  EXPECT_EQ(good.child_frame_id, "base_link");
  expectCovariance(good.pose.covariance);
  step.estimate.valid = false;
  step.estimate.motions.clear();
  step.estimate.world_changes = 3;
  step.T_world_camera = cameraAt(6);
  const mvo::MotionArray array = messages.motions(step, mount);
  EXPECT_TRUE(array.lost);
  EXPECT_EQ(array.world_changes, 3U);
  EXPECT_TRUE(array.motions.empty());
  const nav_msgs::Odometry lost = odometryMessage(array, step, mount);
  const Step next = stepAt(6);
  const nav_msgs::Odometry there = odometryMessage(messages.motions(next, mount), next, mount);
  EXPECT_TRUE(eigen(lost.pose.pose).isApprox(eigen(there.pose.pose), 1e-9));
  EXPECT_EQ(lost.pose.covariance[0], kUnknownVariance);
  EXPECT_EQ(lost.twist.covariance[35], kUnknownVariance);
}

TEST(MovingObjects, AreFoundByTheirBoxes) {
  MotionMessages messages("motion_");
  const Mount mount = mountAlone("odom", "cam");
  messages.motions(stepAt(4), mount);
  const mvo::MotionArray array = messages.motions(stepAt(5), mount);
  Eigen::Vector3d center;
  tf2::fromMsg(array.motions[1].extent_center, center);
  const auto at = movingObjects(array, center, 0.01);
  ASSERT_EQ(at.size(), 1U);
  EXPECT_EQ(at[0].id, kBody);
  EXPECT_EQ(at[0].distance, 0);
  EXPECT_NEAR(at[0].extent.y, 0.4, 1e-12);
  expectCovariance(at[0].pose.covariance);
  expectCovariance(at[0].velocity.covariance);
  // The centre's velocity, against differences of the centre itself.
  const Eigen::Vector3d c_body(0.1, 0, 0);
  const double h = 1e-4;
  const auto centerAt = [&](double k) {
    return Eigen::Vector3d(
        mount.T_odom_world *
        (Eigen::Translation3d(-1, 0.5, 4) * mvo::exp(k * twist(0.05, 0, 0, 0, 0, 0.03)) * c_body));
  };
  const Eigen::Vector3d expected = (centerAt(5 + h) - centerAt(5 - h)) / (2 * h * kPeriod);
  const auto& v = at[0].velocity.twist.linear;
  EXPECT_LT((Eigen::Vector3d(v.x, v.y, v.z) - expected).norm(), 1e-6);

  EXPECT_TRUE(movingObjects(array, center + Eigen::Vector3d(5, 0, 0), 1).empty());
  EXPECT_EQ(movingObjects(array, center + Eigen::Vector3d(5, 0, 0), 0).size(), 1U);
  mvo::MotionArray resting = array;
  resting.motions[1].moving = 0;
  EXPECT_TRUE(movingObjects(resting, center, 0).empty());
}

TEST(CloudMessage, MayBeEmpty) {
  const sensor_msgs::PointCloud2 cloud = cloudMessage(stepAt(0), 0.3);
  EXPECT_EQ(cloud.width * cloud.height, 0U);
  EXPECT_EQ(cloud.fields.size(), 6U);
}

TEST(CloudMessage, HasPlacesColoursAndLabels) {
  Step step = stepAt(5);
  mvo::LabeledPoint near;
  near.tracklet = 12;
  near.id = kBody;
  near.y = {420, 240, 370};  // disparity 50: z = 500 * 0.2 / 50 = 2 m, x = 0.4 m
  mvo::LabeledPoint far = near;
  far.y.z() = far.y.x() - 0.01;
  step.estimate.points = {near, far};
  const sensor_msgs::PointCloud2 cloud = cloudMessage(step, 0.3);
  EXPECT_EQ(cloud.header.frame_id, "cam");
  EXPECT_EQ(cloud.header.stamp, step.stamp);
  ASSERT_EQ(cloud.width * cloud.height, 1U);
  const sensor_msgs::PointCloud2ConstIterator<float> x(cloud, "x");
  const sensor_msgs::PointCloud2ConstIterator<std::uint8_t> rgb(cloud, "rgb");
  const sensor_msgs::PointCloud2ConstIterator<std::int32_t> label(cloud, "label");
  const sensor_msgs::PointCloud2ConstIterator<std::uint32_t> tracklet(cloud, "tracklet");
  EXPECT_NEAR(x[0], 0.4, 1e-6);
  EXPECT_NEAR(x[2], 2.0, 1e-6);
  EXPECT_EQ(*label, kBody);
  EXPECT_EQ(*tracklet, 12U);
  const auto [red, green, blue] = mvo::motionColor(kBody);
  EXPECT_EQ(rgb[2], red);
  EXPECT_EQ(rgb[1], green);
  EXPECT_EQ(rgb[0], blue);
}

}  // namespace
}  // namespace mvo_ros
