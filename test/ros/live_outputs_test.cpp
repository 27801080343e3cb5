// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// All that the live node publishes, against the library called directly on the same images.
#include <gtest/gtest.h>
#include <nav_msgs/Path.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include <Eigen/Eigenvalues>
#include <map>

#include "edges/motion_color.hpp"
#include "mvo/odometry.hpp"
#include "mvo/se3.hpp"
#include "ros/parameters/parameters.hpp"
#include "support/live_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::difference;
using mvo::test::eventually;
using mvo::test::isometry;
using mvo::test::kCameraFrame;
using mvo::test::Recorder;
using Covariance = geometry_msgs::PoseWithCovariance::_covariance_type;

constexpr std::size_t kFrames = 30;

// A camera on a mast, looking ahead, tilted a little.
Eigen::Isometry3d baseToCamera() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  T.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(0.6, 0, 0.8)));
  T.translation() << 0.3, -0.05, 1.2;
  return T;
}

ros::Time stampOf(std::size_t k) { return ros::Time(1000.0) + ros::Duration(k / 15.0); }

// What is recorded of one run, and what the library says of the same images.
struct Session {
  Session() : live("/mvo", mvo::test::CameraTopics::stereo()) {}

  mvo::test::LiveRun live;
  tf2_ros::StaticTransformBroadcaster static_tf;
  Recorder<nav_msgs::Path> path{"/mvo/path"};
  Recorder<sensor_msgs::PointCloud2> points{"/mvo/points"};
  Recorder<sensor_msgs::Image> segmentation{"/mvo/segmentation"};
  Recorder<tf2_msgs::TFMessage> tf{"/tf"};
  mvo::test::Recording recording;
  int window = 0;
  std::vector<mvo::MultimotionEstimate> direct;
};

class LiveOutputs : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    run = new Session();
    run->recording = mvo::test::recordBlocks(kFrames);
    geometry_msgs::TransformStamped mount = tf2::eigenToTransform(baseToCamera());
    mount.header.frame_id = "base_link";
    mount.child_frame_id = kCameraFrame;
    run->static_tf.sendTransform(mount);
    ASSERT_TRUE(run->live.connected());
    ASSERT_TRUE(eventually([] {
      return run->path.connected() && run->points.connected() && run->segmentation.connected() &&
             run->tf.connected();
    }));

    XmlRpc::XmlRpcValue tree;
    ASSERT_TRUE(ros::param::get("/mvo", tree));
    const mvo::Options options = readParameters(tree).method;
    run->window = options.window.frames;
    mvo::MultimotionOdometry odometry(run->recording.camera, options);
    for (std::size_t k = 0; k < kFrames; ++k) {
      mvo::test::CameraSet set = mvo::test::stereoSet(run->recording, k);
      stamp(set, stampOf(k));
      ASSERT_TRUE(run->live.step(set)) << "no motions of frame " << k;
      mvo::Frame frame = mvo::sim::toFrame(run->recording.frames[k]);
      frame.stamp_ns = static_cast<std::int64_t>(stampOf(k).toNSec());
      run->direct.push_back(odometry.addFrame(frame));
    }
    ASSERT_TRUE(eventually([] {
      return run->path.size() == kFrames && run->points.size() == kFrames &&
             run->segmentation.size() == kFrames && run->tf.size() >= kFrames;
    }));
  }
  static void TearDownTestSuite() {
    delete run;
    run = nullptr;
  }

  static std::vector<mvo::MotionArrayConstPtr> arrays() { return run->live.motions.all(); }
  static std::vector<nav_msgs::OdometryConstPtr> odometry() { return run->live.odometry.all(); }

  static Session* run;
};

Session* LiveOutputs::run = nullptr;

TEST_F(LiveOutputs, EveryTopicHasTheLeftImagesStampAndItsFrame) {
  ASSERT_EQ(arrays().size(), kFrames);
  ASSERT_EQ(odometry().size(), kFrames);
  for (std::size_t k = 0; k < kFrames; ++k) {
    const auto& array = *arrays()[k];
    EXPECT_EQ(array.header.stamp, stampOf(k));
    EXPECT_EQ(array.header.frame_id, "odom");
    EXPECT_EQ(array.camera_frame_id, kCameraFrame);
    EXPECT_EQ(array.static_id, mvo::kStatic);
    EXPECT_EQ(array.resets, 0U);
    EXPECT_EQ(odometry()[k]->header.stamp, stampOf(k));
    EXPECT_EQ(odometry()[k]->header.frame_id, "odom");
    EXPECT_EQ(odometry()[k]->child_frame_id, "base_link");
    EXPECT_EQ(run->points.all()[k]->header.stamp, stampOf(k));
    EXPECT_EQ(run->points.all()[k]->header.frame_id, kCameraFrame);
    const sensor_msgs::Image& image = *run->segmentation.all()[k];
    EXPECT_EQ(image.header.stamp, stampOf(k));
    EXPECT_EQ(image.header.frame_id, kCameraFrame);
    EXPECT_EQ(image.encoding, "bgr8");
    EXPECT_EQ(image.width % 320, 0U);  // small images are drawn enlarged
    EXPECT_GT(image.height, 240U);
    const nav_msgs::Path& path = *run->path.all()[k];
    EXPECT_EQ(path.header.stamp, stampOf(k));
    EXPECT_EQ(path.header.frame_id, "odom");
    ASSERT_EQ(path.poses.size(), k + 1);
    EXPECT_EQ(path.poses.back().header.stamp, stampOf(k));
    EXPECT_EQ(path.poses.back().pose, odometry()[k]->pose.pose);
  }
}

TEST_F(LiveOutputs, MotionsAreTheLibrarysSeenFromTheBase) {
  const Eigen::Isometry3d T_base_camera = baseToCamera();
  const Eigen::Isometry3d& T_odom_world = T_base_camera;  // odom: the base's first pose
  std::size_t most = 0;
  for (std::size_t k = 0; k < kFrames; ++k) {
    const mvo::MultimotionEstimate& direct = run->direct[k];
    const mvo::MotionArray& array = *arrays()[k];
    ASSERT_EQ(array.lost, !direct.valid) << "frame " << k;
    if (!direct.valid) continue;
    most = std::max(most, mvo::test::bodies(array));
    ASSERT_EQ(mvo::test::bodies(array) + 1, direct.motions.size());
    for (const mvo::MotionEstimate& expected : direct.motions) {
      const auto found =
          std::find_if(array.motions.begin(), array.motions.end(),
                       [&expected](const mvo::Motion& m) { return m.id == expected.id; });
      ASSERT_NE(found, array.motions.end());
      const bool is_static = expected.id == mvo::kStatic;
      EXPECT_EQ(found->is_static, is_static);
      EXPECT_EQ(found->child_frame_id,
                is_static ? "base_link" : "motion_" + std::to_string(expected.id));
      const Eigen::Isometry3d T_odom_motion =
          T_odom_world * expected.T_world_motion *
          (is_static ? T_base_camera.inverse() : Eigen::Isometry3d::Identity());
      EXPECT_LT(difference(isometry(found->pose.pose), T_odom_motion), 1e-6)
          << "motion " << expected.id << " at frame " << k;
      if (!is_static) {
        EXPECT_LT(difference(isometry(found->egocentric.pose), expected.T_ck_motion), 1e-6);
      }
      EXPECT_EQ(found->support, static_cast<unsigned>(expected.support));
      EXPECT_EQ(found->visible, static_cast<unsigned>(expected.visible));
    }
    EXPECT_EQ(array.motions.front().pose.pose, odometry()[k]->pose.pose);
    EXPECT_EQ(array.motions.front().twist.twist, odometry()[k]->twist.twist);
  }
  EXPECT_EQ(most, 4U) << "blocks";
}

TEST_F(LiveOutputs, TrajectoriesSpanTheWindow) {
  for (std::size_t k = 2; k < kFrames; ++k) {
    const mvo::MotionArray& array = *arrays()[k];
    if (array.lost) continue;
    const std::size_t length = std::min(k + 1, static_cast<std::size_t>(run->window));
    EXPECT_EQ(array.window_begin, stampOf(k + 1 - length));
    EXPECT_EQ(array.window_end, stampOf(k));
    EXPECT_EQ(array.motions.front().trajectory.size(), length) << "frame " << k;
    for (const mvo::Motion& motion : array.motions) {
      if (motion.state > mvo::Motion::TRACKED) continue;
      ASSERT_GE(motion.trajectory.size(), 2U);
      ASSERT_EQ(motion.trajectory.size(), motion.egocentric_trajectory.size());
      EXPECT_LE(motion.trajectory.size(), length);
      for (std::size_t i = 0; i < motion.trajectory.size(); ++i) {
        EXPECT_EQ(motion.trajectory[i].header.stamp, motion.egocentric_trajectory[i].header.stamp);
        EXPECT_EQ(motion.trajectory[i].header.frame_id, "odom");
        EXPECT_EQ(motion.egocentric_trajectory[i].header.frame_id, kCameraFrame);
        if (i > 0) {
          EXPECT_LT(motion.trajectory[i - 1].header.stamp, motion.trajectory[i].header.stamp);
        }
      }
      EXPECT_EQ(motion.trajectory.back().header.stamp, array.header.stamp);
      EXPECT_LT(difference(isometry(motion.trajectory.back().pose), isometry(motion.pose.pose)),
                1e-9);
      EXPECT_LT(difference(isometry(motion.egocentric_trajectory.back().pose),
                           isometry(motion.egocentric.pose)),
                1e-9);
    }
  }
}

void expectCovariance(const Covariance& values, const std::string& what) {
  const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> matrix(values.data());
  ASSERT_TRUE(matrix.allFinite()) << what;
  EXPECT_EQ(matrix, matrix.transpose()) << what;
  const Eigen::SelfAdjointEigenSolver<mvo::Matrix6d> solver(matrix);
  EXPECT_GT(solver.eigenvalues().minCoeff(), 0) << what;
}

TEST_F(LiveOutputs, CovariancesAreFinitePositiveAndSymmetric) {
  for (std::size_t k = 3; k < kFrames; ++k) {
    for (const mvo::Motion& motion : arrays()[k]->motions) {
      const std::string what = "motion " + std::to_string(motion.id) + ", frame " +
                               std::to_string(k) + ", state " + std::to_string(motion.state);
      expectCovariance(motion.pose.covariance, "pose of " + what);
      expectCovariance(motion.twist.covariance, "twist of " + what);
      expectCovariance(motion.egocentric.covariance, "egocentric pose of " + what);
    }
    expectCovariance(odometry()[k]->pose.covariance, "odometry");
    expectCovariance(odometry()[k]->twist.covariance, "odometry's twist");
  }
}

// Within one window's trajectory exactly; against what was said a frame ago within what the window
// has learnt since.
TEST_F(LiveOutputs, TwistsAreThePosesDifferences) {
  int compared = 0;
  for (std::size_t k = 3; k < kFrames; ++k) {
    const double period = (stampOf(k) - stampOf(k - 1)).toSec();
    for (const mvo::Motion& motion : arrays()[k]->motions) {
      const auto& path = motion.trajectory;
      if (motion.state != mvo::Motion::TRACKED || path.size() < 2 ||
          path[path.size() - 2].header.stamp != stampOf(k - 1))
        continue;
      const Eigen::Isometry3d step =
          isometry(path[path.size() - 2].pose).inverse() * isometry(path.back().pose);
      EXPECT_LT(difference(isometry(motion.motion_since_last), step), 1e-6)
          << "motion " << motion.id << " at frame " << k;
      mvo::Vector6d twist;
      twist << motion.twist.twist.linear.x, motion.twist.twist.linear.y,
          motion.twist.twist.linear.z, motion.twist.twist.angular.x, motion.twist.twist.angular.y,
          motion.twist.twist.angular.z;
      EXPECT_LT((twist - mvo::log(step) / period).norm(), 1e-4);
      ++compared;
    }
    const Eigen::Isometry3d causal =
        isometry(odometry()[k - 1]->pose.pose).inverse() * isometry(odometry()[k]->pose.pose);
    EXPECT_LT(difference(causal, isometry(arrays()[k]->motions.front().motion_since_last)), 5e-3);
  }
  EXPECT_GT(compared, 100);
}

TEST_F(LiveOutputs, CloudHasLabelsAndColoursOfTheMotions) {
  const sensor_msgs::PointCloud2& cloud = *run->points.last();
  std::vector<std::string> fields;
  for (const auto& field : cloud.fields) fields.push_back(field.name);
  EXPECT_EQ(fields, (std::vector<std::string>{"x", "y", "z", "rgb", "label", "tracklet"}));
  ASSERT_EQ(cloud.width * cloud.height, run->direct.back().points.size());
  sensor_msgs::PointCloud2ConstIterator<float> xyz(cloud, "x");
  sensor_msgs::PointCloud2ConstIterator<std::uint8_t> rgb(cloud, "rgb");
  sensor_msgs::PointCloud2ConstIterator<std::int32_t> label(cloud, "label");
  sensor_msgs::PointCloud2ConstIterator<std::uint32_t> tracklet(cloud, "tracklet");
  std::map<int, int> points_of;
  for (const mvo::LabeledPoint& point : run->direct.back().points) {
    const Eigen::Vector3d p(xyz[0], xyz[1], xyz[2]);
    EXPECT_LT((p - run->recording.camera.backProject(point.y)).norm(), 1e-4 * p.norm());
    EXPECT_EQ(*label, point.id);
    EXPECT_EQ(*tracklet, static_cast<unsigned>(point.tracklet));
    const auto [red, green, blue] = mvo::motionColor(point.id);
    EXPECT_EQ((std::vector<int>{rgb[2], rgb[1], rgb[0]}), (std::vector<int>{red, green, blue}));
    ++points_of[point.id];
    ++xyz, ++rgb, ++label, ++tracklet;
  }
  EXPECT_GE(points_of.size(), 5U);  // the world and four blocks
}

TEST_F(LiveOutputs, TfHasTheBaseAndEveryMotion) {
  std::map<std::pair<ros::Time, std::string>, Eigen::Isometry3d> transforms;
  for (const auto& message : run->tf.all())
    for (const auto& T : message->transforms) {
      EXPECT_EQ(T.header.frame_id, "odom");
      transforms[{T.header.stamp, T.child_frame_id}] = tf2::transformToEigen(T);
    }
  std::size_t expected = 0;
  for (const auto& array : arrays()) {
    if (array->lost) ++expected;  // the base alone
    for (const mvo::Motion& motion : array->motions) {
      if (motion.state == mvo::Motion::LOST) continue;
      ++expected;
      const auto T = transforms.find({array->header.stamp, motion.child_frame_id});
      ASSERT_NE(T, transforms.end()) << motion.child_frame_id << " at " << array->header.stamp;
      EXPECT_LT(difference(T->second, isometry(motion.pose.pose)), 1e-9);
    }
  }
  EXPECT_EQ(transforms.size(), expected);
}

TEST_F(LiveOutputs, DiagnosticsSumUp) {
  ASSERT_TRUE(
      eventually([] { return run->live.diagnostics.value("frames") == std::to_string(kFrames); }));
  const auto value = [](const std::string& key) { return run->live.diagnostics.value(key); };
  EXPECT_EQ(value("state"), "ok");
  EXPECT_EQ(value("frames dropped"), "0");
  EXPECT_EQ(value("frames refused"), "0");
  EXPECT_EQ(value("resets"), "0");
  EXPECT_EQ(value("motions"), std::to_string(run->direct.back().motions.size()));
  EXPECT_EQ(value("tracklets"), std::to_string(run->direct.back().points.size()));
  for (const char* key : {"rate", "latency", "in the node", "step", "stage decode", "last error"})
    EXPECT_FALSE(value(key).empty()) << key;
}

TEST(LiveOutputsSkewed, ApproximateSetsHaveTheLeftImagesStamp) {
  mvo::test::LiveRun live("/skewed/approximate", mvo::test::CameraTopics::stereo("/skewed"));
  const auto recording = mvo::test::recordBlocks(6);
  ASSERT_TRUE(live.connected());
  for (std::size_t k = 0; k < 6; ++k) {
    mvo::test::CameraSet set = mvo::test::stereoSet(recording, k);
    stamp(set, stampOf(k));
    set.right.header.stamp += ros::Duration(0.004);
    set.right_info.header.stamp += ros::Duration(0.004);
    live.camera.publish(set);
  }
  // A set is complete when the next messages show that none fits better.
  ASSERT_TRUE(eventually([&live] { return live.motions.size() >= 5; }));
  const auto motions = live.motions.all();
  for (std::size_t k = 0; k < motions.size(); ++k) EXPECT_EQ(motions[k]->header.stamp, stampOf(k));
  EXPECT_FALSE(motions[4]->lost);
  // Without a base frame the camera's frame takes its place and odom has ROS axes.
  EXPECT_EQ(live.odometry.all()[4]->child_frame_id, kCameraFrame);
  const Eigen::Isometry3d T_odom_camera = isometry(live.odometry.all()[0]->pose.pose);
  EXPECT_LT((T_odom_camera.linear() * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitX()).norm(),
            1e-9);
}

}  // namespace
}  // namespace mvo_ros
