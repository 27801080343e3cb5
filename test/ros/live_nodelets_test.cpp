// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Both nodelets in one manager, and parameters that nobody can use: the node ends with a sentence,
// a nodelet is not loaded, the manager lives on.
#include <gtest/gtest.h>

#include <limits>

#include "support/live_run.hpp"
#include "support/tool_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::CameraSet;
using mvo::test::difference;
using mvo::test::eventually;
using mvo::test::isometry;

constexpr std::size_t kFrames = 16;

CameraSet stamped(CameraSet set, std::size_t k) {
  stamp(set, ros::Time(500) + ros::Duration(static_cast<double>(k) / 15));
  return set;
}

Eigen::Isometry3d travelled(const mvo::test::LiveRun& live) {
  const auto odometry = live.odometry.all();
  return isometry(odometry.front()->pose.pose).inverse() * isometry(odometry.back()->pose.pose);
}

Eigen::Isometry3d truth(const mvo::test::Recording& recording) {
  return recording.frames.front().T_world_camera.inverse() * recording.frames.back().T_world_camera;
}

TEST(LiveNodelets, RgbdTakesMillimetresAndMetresWithHoles) {
  mvo::test::LiveRun live("/depth/mvo", mvo::test::CameraTopics::rgbd("/depth"));
  mvo::sim::SceneOptions options;
  options.rgbd = true;
  const auto recording = mvo::test::recordBlocks(kFrames, options);
  ASSERT_TRUE(live.connected());
  for (std::size_t k = 0; k < kFrames; ++k) {
    CameraSet set = mvo::test::rgbdSet(recording, k);
    if (k % 2 == 1) {  // the same in metres
      cv::Mat metres = recording.frames[k].depth.clone();
      metres.rowRange(0, 20).setTo(std::numeric_limits<float>::quiet_NaN());
      metres.rowRange(20, 30).setTo(0);
      metres.rowRange(30, 40).setTo(std::numeric_limits<float>::infinity());
      set.right = mvo::test::imageMessage(metres, "32FC1");
    }
    const auto array = live.step(stamped(set, k));
    ASSERT_TRUE(array) << "frame " << k;
    EXPECT_EQ(array->lost, k == 0 ? array->lost : false) << "frame " << k;
  }
  EXPECT_LT(difference(travelled(live), truth(recording)), 0.03);
  EXPECT_GE(mvo::test::bodies(*live.motions.last()), 3U);
  EXPECT_EQ(live.motions.last()->resets, 0U);
}

// Ends by itself with a failure; what it says.
std::string refusalOf(const std::string& command) {
  const mvo::test::ToolRun run = mvo::test::runTool("timeout 60 " + command);
  EXPECT_NE(run.exit_code, 0) << command;
  EXPECT_NE(run.exit_code, 124) << command << " did not end";
  EXPECT_TRUE(run.exit_code < 128 || run.exit_code == 255) << command << " ended by a signal";
  return run.out + run.err;
}

struct BadParameter {
  std::string argument;
  std::vector<std::string> sentence;
};

const std::vector<BadParameter>& badParameters() {
  static const std::vector<BadParameter> all = {
      {"_energy/treshold:=1.5", {"'energy.treshold'", "energy.threshold"}},
      {"_window/frames:=many", {"window.frames", "'many'", "[3, 500]"}},
      {"_sync_queue:=0", {"sync_queue", "'0'", "[1, 1000]"}},
      {"_queue:=some", {"queue", "'some'", "newest | all"}},
      {"_image_transport:=pigeon", {"image_transport", "'pigeon'", "raw"}}};
  return all;
}

TEST(LiveNodelets, TheNodeEndsWithASentenceOnBadParameters) {
  int number = 0;
  for (const auto& [argument, sentence] : badParameters()) {
    const std::string said = refusalOf("rosrun mvo mvo_node __name:=bad_node_" +
                                       std::to_string(number++) + " " + argument);
    EXPECT_TRUE(mvo::test::says(said, sentence)) << argument << ": " << said;
  }
}

TEST(LiveNodelets, TheManagerSurvivesNodeletsWithBadParameters) {
  mvo::test::LiveRun live("/pair/mvo", mvo::test::CameraTopics::stereo("/pair"));
  const auto recording = mvo::test::recordBlocks(kFrames);
  ASSERT_TRUE(live.connected());
  for (std::size_t k = 0; k < kFrames / 2; ++k)
    ASSERT_TRUE(live.step(stamped(mvo::test::stereoSet(recording, k), k)));

  mvo::test::LogRecorder manager("/manager");
  ASSERT_TRUE(eventually([] { return ros::service::exists("/manager/load_nodelet", false); }));
  int number = 0;
  for (const auto& [argument, sentence] : badParameters()) {
    refusalOf("rosrun nodelet nodelet load mvo/StereoNodelet /manager __name:=bad_nodelet_" +
              std::to_string(number++) + " " + argument);
    EXPECT_TRUE(eventually([&manager, wanted = sentence] { return manager.said(wanted); }, 10))
        << argument;
  }
  for (std::size_t k = kFrames / 2; k < kFrames; ++k)
    ASSERT_TRUE(live.step(stamped(mvo::test::stereoSet(recording, k), k)));
  EXPECT_LT(difference(travelled(live), truth(recording)), 0.03);
  EXPECT_EQ(mvo::test::bodies(*live.motions.last()), 4U);
}

}  // namespace
}  // namespace mvo_ros
