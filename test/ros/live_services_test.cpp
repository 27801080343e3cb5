// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the live node can be asked and told while it runs.
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <mvo/CameraErrors.h>
#include <mvo/GetCameraInfo.h>
#include <mvo/GetMovingObjects.h>
#include <mvo/SaveCameraErrors.h>
#include <mvo/SaveTrajectories.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "mvo/camera_error_files.hpp"
#include "mvo/trajectory_files.hpp"
#include "support/live_run.hpp"
#include "support/temporary_folder.hpp"

namespace mvo_ros {
namespace {

using mvo::test::eventually;
using mvo::test::says;

constexpr std::size_t kFrames = 20;

class LiveServices : public ::testing::Test {
 protected:
  struct Session {
    mvo::test::LiveRun live{"/mvo", mvo::test::CameraTopics::stereo()};
    mvo::test::Recorder<tf2_msgs::TFMessage> tf{"/tf"};
    mvo::test::Recording recording = mvo::test::recordBlocks(kFrames);
    std::size_t sets = 0;
  };

  static void SetUpTestSuite() {
    s = new Session();
    ASSERT_TRUE(s->live.connected());
    ASSERT_TRUE(eventually([] { return s->tf.connected(); }));
  }
  static void TearDownTestSuite() {
    delete s;
    s = nullptr;
  }

  static mvo::test::CameraSet nextSet(std::size_t k) {
    mvo::test::CameraSet set = mvo::test::stereoSet(s->recording, k);
    stamp(set, ros::Time(200) + ros::Duration(static_cast<double>(s->sets++) / 15));
    return set;
  }
  // The recording from its start in a new world, until all blocks are known.
  static void run() {
    std_srvs::Trigger reset;
    ASSERT_TRUE(ros::service::call("/mvo/reset", reset));
    for (std::size_t k = 0; k < kFrames; ++k) ASSERT_TRUE(s->live.step(nextSet(k)));
    ASSERT_EQ(mvo::test::bodies(*s->live.motions.last()), 4U);
  }
  static std_srvs::Trigger::Response trigger(const std::string& name) {
    std_srvs::Trigger call;
    EXPECT_TRUE(ros::service::call("/mvo/" + name, call)) << name;
    return call.response;
  }
  static mvo::GetMovingObjects::Response objectsNear(const std::string& frame,
                                                     const geometry_msgs::Point& point,
                                                     double radius) {
    mvo::GetMovingObjects call;
    call.request.center.header.frame_id = frame;
    call.request.center.point = point;
    call.request.radius = radius;
    EXPECT_TRUE(ros::service::call("/mvo/get_moving_objects", call));
    return call.response;
  }

  static Session* s;
};

LiveServices::Session* LiveServices::s = nullptr;

TEST_F(LiveServices, BeforeTheFirstFrameTheySayThatThereIsNothing) {
  const auto objects = objectsNear("", geometry_msgs::Point(), 0);
  EXPECT_FALSE(objects.success);
  EXPECT_TRUE(says(objects.message, {"no estimate yet"})) << objects.message;
  mvo::SaveTrajectories save;
  save.request.folder = "/tmp";
  ASSERT_TRUE(ros::service::call("/mvo/save_trajectories", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_TRUE(says(save.response.message, {"no poses yet"})) << save.response.message;
  mvo::GetCameraInfo info;
  ASSERT_TRUE(ros::service::call("/mvo/get_camera_info", info));
  EXPECT_FALSE(info.response.success);
  EXPECT_TRUE(says(info.response.message, {"no estimate yet"})) << info.response.message;
}

TEST_F(LiveServices, MovingObjectsNearAndFar) {
  run();
  const mvo::MotionArray array = *s->live.motions.last();
  const auto everywhere = objectsNear("", geometry_msgs::Point(), 0);
  ASSERT_TRUE(everywhere.success) << everywhere.message;
  EXPECT_EQ(everywhere.header.stamp, array.header.stamp);
  EXPECT_EQ(everywhere.header.frame_id, "odom");
  std::size_t moving = 0;
  for (const mvo::Motion& motion : array.motions)
    if (!motion.is_static && motion.moving) ++moving;
  ASSERT_EQ(everywhere.objects.size(), moving);
  ASSERT_GE(moving, 2U);
  for (std::size_t i = 1; i < moving; ++i)
    EXPECT_GE(everywhere.objects[i].distance, everywhere.objects[i - 1].distance);
  for (const mvo::MovingObject& object : everywhere.objects) {
    EXPECT_GT(object.extent.x * object.extent.y, 0);
    const auto here = objectsNear("odom", object.pose.pose.position, 1e-3);
    ASSERT_TRUE(here.success);
    ASSERT_FALSE(here.objects.empty());
    EXPECT_EQ(here.objects.front().distance, 0);
  }
  geometry_msgs::Point far;
  far.x = -1000;
  const auto none = objectsNear("odom", far, 1);
  EXPECT_TRUE(none.success) << none.message;
  EXPECT_TRUE(none.objects.empty());
}

TEST_F(LiveServices, MovingObjectsInAnotherFrameThroughTf) {
  tf2_ros::StaticTransformBroadcaster broadcaster;
  geometry_msgs::TransformStamped T;
  T.header.frame_id = "map";
  T.child_frame_id = "odom";
  T.transform.translation.x = 100;
  T.transform.rotation.z = 1;  // half a turn
  broadcaster.sendTransform(T);
  const auto all = objectsNear("odom", geometry_msgs::Point(), 0);
  ASSERT_FALSE(all.objects.empty());
  geometry_msgs::Point in_map = all.objects.front().pose.pose.position;
  in_map.x = 100 - in_map.x;
  in_map.y = -in_map.y;
  mvo::GetMovingObjects::Response there;
  ASSERT_TRUE(eventually([&] { return (there = objectsNear("map", in_map, 0.01)).success; }))
      << there.message;
  ASSERT_FALSE(there.objects.empty());
  EXPECT_EQ(there.objects.front().id, all.objects.front().id);
  EXPECT_EQ(there.header.frame_id, "odom");
}

TEST_F(LiveServices, MovingObjectsRefusesWhatItCannotAnswer) {
  const auto unknown = objectsNear("nowhere", geometry_msgs::Point(), 1);
  EXPECT_FALSE(unknown.success);
  EXPECT_TRUE(says(unknown.message, {"no transform from nowhere to odom"})) << unknown.message;
  EXPECT_FALSE(objectsNear("", geometry_msgs::Point(), -1).success);
  geometry_msgs::Point nan;
  nan.x = std::nan("");
  EXPECT_FALSE(objectsNear("", nan, 1).success);
}

TEST_F(LiveServices, TrajectoriesAreSavedButNeverOverwritten) {
  const mvo::test::TemporaryFolder folder;
  mvo::SaveTrajectories save;
  save.request.folder = "relative/folder";
  ASSERT_TRUE(ros::service::call("/mvo/save_trajectories", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_TRUE(says(save.response.message, {"'relative/folder'", "absolute"}));

  save.request.folder = (folder / "run").string();
  ASSERT_TRUE(ros::service::call("/mvo/save_trajectories", save));
  ASSERT_TRUE(save.response.success) << save.response.message;
  const auto camera = mvo::readTum(folder / "run" / "camera.tum");
  std::size_t valid = 0;
  const unsigned resets = s->live.motions.last()->resets;
  for (const auto& array : s->live.motions.all())
    if (array->resets == resets && !array->lost) ++valid;
  EXPECT_EQ(camera.size(), valid);
  EXPECT_EQ(camera.back().stamp_ns,
            static_cast<std::int64_t>(s->live.motions.last()->header.stamp.toNSec()));
  for (const mvo::Motion& motion : s->live.motions.last()->motions) {
    const std::string file = "motion_" + std::to_string(motion.id) + ".tum";
    if (!motion.is_static) {
      EXPECT_FALSE(mvo::readTum(folder / "run" / file).empty());
    }
  }

  ASSERT_TRUE(ros::service::call("/mvo/save_trajectories", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_TRUE(says(save.response.message, {"exists and is not overwritten"}));
  EXPECT_EQ(mvo::readTum(folder / "run" / "camera.tum").size(), valid);
}

TEST_F(LiveServices, TellsWhatTheCamerasDifferBy) {
  mvo::test::Recorder<mvo::CameraErrors> errors("/mvo/camera_errors");
  ASSERT_TRUE(eventually([&] { return errors.size() > 0; })) << "latched";
  EXPECT_EQ(errors.last()->terms.size(), errors.last()->values.size());
  EXPECT_FALSE(errors.last()->significant) << errors.last()->advice;

  mvo::GetCameraInfo info;
  ASSERT_TRUE(ros::service::call("/mvo/get_camera_info", info));
  ASSERT_TRUE(info.response.success) << info.response.message;
  EXPECT_TRUE(says(info.response.message, {"nothing significant", "px rms"}))
      << info.response.message;
  EXPECT_GT(-info.response.right.P[3], 0);
  EXPECT_EQ(info.response.left.P[3], 0);
  EXPECT_NEAR(info.response.right.R[0], 1, 1e-3);

  const mvo::test::TemporaryFolder folder;
  mvo::SaveCameraErrors save;
  save.request.file = "relative.json";
  ASSERT_TRUE(ros::service::call("/mvo/save_camera_errors", save));
  EXPECT_FALSE(save.response.success);
  EXPECT_TRUE(says(save.response.message, {"'relative.json'", "absolute"}));
  save.request.file = (folder / "pair.json").string();
  ASSERT_TRUE(ros::service::call("/mvo/save_camera_errors", save));
  ASSERT_TRUE(save.response.success) << save.response.message;
  const mvo::LearntCameraErrors saved = mvo::readCameraErrors(folder / "pair.json");
  EXPECT_EQ(saved.terms, errors.last()->terms);
  EXPECT_NEAR(saved.camera.fu, info.response.right.P[0], 1e-9);
}

TEST_F(LiveServices, ResetStartsANewWorldWithTheNextFrame) {
  const unsigned before = s->live.motions.last()->resets;
  EXPECT_TRUE(trigger("reset").success);
  ASSERT_TRUE(s->live.step(nextSet(5)));
  const mvo::MotionArray array = *s->live.motions.last();
  EXPECT_EQ(array.resets, before + 1);
  EXPECT_EQ(array.window_begin, array.header.stamp);
  EXPECT_TRUE(eventually([] { return s->live.log.said({"starts anew", "asked for by service"}); }));
}

TEST_F(LiveServices, APausedNodeLetsFramesPass) {
  EXPECT_TRUE(trigger("pause").success);
  const auto again = trigger("pause");
  EXPECT_FALSE(again.success);
  EXPECT_EQ(again.message, "already paused");
  const std::size_t before = s->live.motions.size();
  s->live.camera.publish(nextSet(6));
  s->live.diagnostics.clear();
  ASSERT_TRUE(eventually([] {
    return s->live.diagnostics.all().size() >= 2 && s->live.diagnostics.message() == "paused";
  }));
  EXPECT_EQ(s->live.motions.size(), before);
  EXPECT_TRUE(trigger("resume").success);
  EXPECT_FALSE(trigger("resume").success);
  const mvo::test::CameraSet set = nextSet(7);
  ASSERT_TRUE(s->live.step(set));
  EXPECT_EQ(s->live.motions.last()->header.stamp, set.left.header.stamp);
  EXPECT_EQ(s->live.motions.size(), before + 1);
}

dynamic_reconfigure::Config configured(const dynamic_reconfigure::Config& config) {
  dynamic_reconfigure::Reconfigure call;
  call.request.config = config;
  EXPECT_TRUE(ros::service::call("/mvo/live/set_parameters", call));
  return call.response.config;
}

dynamic_reconfigure::Config flag(const std::string& name, bool value) {
  dynamic_reconfigure::Config config;
  config.bools.resize(1);
  config.bools[0].name = name;
  config.bools[0].value = value ? 1 : 0;
  return config;
}

TEST_F(LiveServices, SettingsChangeWhatIsPublished) {
  run();
  const auto motionFrames = [](std::size_t from) {
    std::size_t count = 0;
    const auto messages = s->tf.all();
    for (std::size_t i = from; i < messages.size(); ++i)
      for (const auto& T : messages[i]->transforms)
        if (T.child_frame_id.rfind("motion_", 0) == 0) ++count;
    return count;
  };
  EXPECT_GT(motionFrames(0), 0U);
  configured(flag("publish_motion_tf", false));
  const std::size_t from = s->tf.size();
  for (std::size_t k = kFrames; k-- > kFrames - 4;) ASSERT_TRUE(s->live.step(nextSet(k)));
  ASSERT_TRUE(eventually([&] { return s->tf.size() >= from + 4; }));
  EXPECT_EQ(motionFrames(from), 0U);
  EXPECT_GT(mvo::test::bodies(*s->live.motions.last()), 0U);

  configured(flag("publish_motion_tf", true));
  ASSERT_TRUE(s->live.step(nextSet(kFrames - 3)));
  EXPECT_TRUE(eventually([&] { return motionFrames(from) > 0; }));
}

TEST_F(LiveServices, SettingsOutOfRangeAnswerWithTheValueInForce) {
  dynamic_reconfigure::Config config;
  config.doubles.resize(1);
  config.doubles[0].name = "energy_threshold";
  config.doubles[0].value = 1e9;
  bool found = false;
  for (const auto& value : configured(config).doubles)
    if (value.name == "energy_threshold") {
      EXPECT_EQ(value.value, 100);
      found = true;
    }
  EXPECT_TRUE(found);
  ASSERT_TRUE(s->live.step(nextSet(kFrames - 4)));
  config.doubles[0].value = 1.9;
  configured(config);
  EXPECT_TRUE(s->live.step(nextSet(kFrames - 5)));
}

}  // namespace
}  // namespace mvo_ros
