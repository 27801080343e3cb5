// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What goes wrong in front of the live node: topics that are missing, cameras that stop, change or
// go blind, messages that cannot be read. It says so and goes on.
#include <gtest/gtest.h>
#include <std_srvs/Trigger.h>

#include <opencv2/imgproc.hpp>
#include <optional>

#include "support/live_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::CameraSet;
using mvo::test::CameraTopics;
using mvo::test::difference;
using mvo::test::eventually;
using mvo::test::imageMessage;
using mvo::test::isometry;

constexpr std::size_t kFrames = 40;
constexpr std::size_t kWindow = 12;
constexpr double kJump = 0.1;  // m or rad between frames; the camera moves less than half of it

class LiveInput : public ::testing::Test {
 protected:
  struct Session {
    // The right images are missing: somebody mistyped their name.
    mvo::test::LiveRun live{
        "/mvo", CameraTopics("/left/image_rect", "/left/camera_info", "", "/right/camera_info")};
    std::optional<CameraTopics> mistyped{CameraTopics("", "", "/rigth/image_rect", "")};
    std::optional<CameraTopics> right;
    mvo::test::Recording recording = mvo::test::recordBlocks(kFrames);
    ros::Time now{300};
  };

  static void SetUpTestSuite() {
    s = new Session();
    ASSERT_TRUE(s->live.connected());
  }
  static void TearDownTestSuite() {
    delete s;
    s = nullptr;
  }

  static CameraSet stamped(CameraSet set) {
    s->now += ros::Duration(1 / 15.0);
    stamp(set, s->now);
    return set;
  }
  static CameraSet frame(std::size_t k) { return mvo::test::stereoSet(s->recording, k); }
  static void publish(const CameraSet& set) {
    s->live.camera.publish(set);
    if (s->right) s->right->publishRight(set);
  }
  // Publishes a set and waits for what the node makes of it.
  static mvo::MotionArrayConstPtr step(const CameraSet& unstamped) {
    const CameraSet set = stamped(unstamped);
    s->right->publishRight(set);
    return s->live.step(set);
  }
  static void reset() {
    std_srvs::Trigger call;
    ASSERT_TRUE(ros::service::call("/mvo/reset", call));
    s->live.motions.clear();
    s->live.odometry.clear();
    s->live.diagnostics.clear();
  }
  static void run(std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) ASSERT_TRUE(step(frame(k))) << "frame " << k;
  }
  static void expectNoJump() {
    mvo::test::expectNoJump(s->live.motions.all(), s->live.odometry.all(), kJump);
  }
  static void expectAllKnown() {
    EXPECT_FALSE(s->live.motions.last()->lost);
    EXPECT_EQ(mvo::test::bodies(*s->live.motions.last()), 4U);
  }
  // Publishes at a camera's pace until a condition holds.
  static bool publishingUntil(const std::function<bool()>& condition,
                              const std::function<void()>& publish_next, double seconds) {
    ros::SteadyTime next = ros::SteadyTime::now();
    return eventually(
        [&] {
          if (ros::SteadyTime::now() >= next) {
            publish_next();
            next += ros::WallDuration(1 / 15.0);
          }
          return condition();
        },
        seconds);
  }

  // No texture: the pose goes on as the camera did, and nothing jumps.
  static void expectLostAndFound(const cv::Mat& image) {
    reset();
    run(0, kWindow);
    expectAllKnown();
    Eigen::Isometry3d last = isometry(s->live.odometry.last()->pose.pose);
    CameraSet blind = frame(0);
    blind.left = blind.right = imageMessage(image);
    for (int blink = 0; blink < 5; ++blink) {
      const auto array = step(blind);
      ASSERT_TRUE(array);
      EXPECT_TRUE(array->lost) << "blind frame " << blink;
      const auto odometry = s->live.odometry.last();
      EXPECT_LT(difference(isometry(odometry->pose.pose), last), kJump / 2);
      last = isometry(odometry->pose.pose);
      for (const std::size_t i : {0, 7, 14, 21, 28, 35}) {
        EXPECT_EQ(odometry->pose.covariance[i], 9999);
        EXPECT_EQ(odometry->twist.covariance[i], 9999);
      }
    }
    EXPECT_TRUE(eventually([] { return s->live.diagnostics.said({"lost: "}); }, 10));
    run(kWindow, 2 * kWindow);
    expectNoJump();
    expectAllKnown();
  }

  static Session* s;
};

LiveInput::Session* LiveInput::s = nullptr;

constexpr double kComplaint = 12;  // s; it should come after 5 to 6, machines may be busy

TEST_F(LiveInput, AMissingTopicIsNamedWithAllOthers) {
  const std::vector<std::string> complaint = {
      "no synchronized set for", "/left/image_rect: 1 publisher, ",
      "/left/camera_info: 1 publisher, ", "/right/image_rect: no publisher, 0 messages",
      "/right/camera_info: 1 publisher, "};
  EXPECT_TRUE(publishingUntil(
      [&] { return s->live.diagnostics.said(complaint) && s->live.log.said(complaint); },
      [] {
        const CameraSet set = stamped(frame(0));
        s->live.camera.publish(set);
        s->mistyped->publishRight(set);
      },
      kComplaint))
      << s->live.diagnostics.message();
  EXPECT_EQ(s->live.motions.size(), 0U);

  s->mistyped.reset();
  s->right.emplace("", "", "/right/image_rect", "");
  ASSERT_TRUE(s->right->connected());
  run(0, kWindow);
  expectAllKnown();
  EXPECT_TRUE(eventually([] { return s->live.diagnostics.value("state") == "ok"; }));
}

TEST_F(LiveInput, ACameraThatStopsIsNamedAndWelcomeBack) {
  reset();
  run(0, kWindow);
  const std::vector<std::string> complaint = {"no synchronized set for",
                                              "/left/image_rect: 1 publisher, ",
                                              "/right/image_rect: 1 publisher, 0 messages"};
  const ros::Time stopped = s->now;
  EXPECT_TRUE(publishingUntil(
      [&] { return s->live.diagnostics.said(complaint) && s->live.log.said(complaint); },
      [] { s->live.camera.publishLeft(stamped(frame(kWindow - 1))); }, kComplaint))
      << s->live.diagnostics.message();
  s->now = std::max(s->now, stopped + ros::Duration(10));
  run(kWindow, 2 * kWindow);
  expectNoJump();
  expectAllKnown();
  EXPECT_EQ(s->live.motions.last()->resets, s->live.motions.all().front()->resets);
}

TEST_F(LiveInput, EncodingsMayChangeWhileItRuns) {
  reset();
  run(0, kWindow);
  std::size_t k = kWindow;
  const unsigned resets = s->live.motions.last()->resets;
  for (const std::string encoding :
       {"mono16", "rgb8", "bgr8", "rgba8", "bgra8", "8UC1", "bayer_rggb8", "bayer_grbg8"}) {
    CameraSet set = frame(k);
    const auto converted = [&encoding](const cv::Mat& grey) {
      cv::Mat out = grey;
      if (encoding == "mono16") grey.convertTo(out, CV_16U, 257);
      if (encoding == "rgb8" || encoding == "bgr8") cv::cvtColor(grey, out, cv::COLOR_GRAY2BGR);
      if (encoding == "rgba8" || encoding == "bgra8") cv::cvtColor(grey, out, cv::COLOR_GRAY2BGRA);
      return imageMessage(out, encoding);
    };
    set.left = converted(s->recording.frames[k].left);
    set.right = converted(s->recording.frames[k].right);
    const auto array = step(set);
    ASSERT_TRUE(array) << encoding;
    EXPECT_FALSE(array->lost) << encoding;
    EXPECT_EQ(array->resets, resets) << encoding;
    ++k;
  }
  const auto& frames = s->recording.frames;
  const Eigen::Isometry3d truth = frames[0].T_world_camera.inverse() * frames[k - 1].T_world_camera;
  const auto odometry = s->live.odometry.all();
  const Eigen::Isometry3d estimate =
      isometry(odometry.front()->pose.pose).inverse() * isometry(odometry.back()->pose.pose);
  EXPECT_LT(difference(estimate, truth), 0.02);
  expectAllKnown();
}

TEST_F(LiveInput, AnotherCalibrationStartsANewWorld) {
  reset();
  run(0, kWindow);
  const unsigned resets = s->live.motions.last()->resets;
  const mvo::test::Recording smaller = mvo::test::recordBlocks(3, {}, 256, 192);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto array = step(mvo::test::stereoSet(smaller, k));
    ASSERT_TRUE(array);
    EXPECT_EQ(array->resets, resets + 1);
  }
  EXPECT_FALSE(s->live.motions.last()->lost);
  EXPECT_TRUE(eventually([] { return s->live.log.said({"the calibration has changed"}); }));
  run(0, 2);
  EXPECT_EQ(s->live.motions.last()->resets, resets + 2);
  for (std::size_t k = 2; k < 4; ++k) {
    CameraSet set = frame(k);
    set.right_info.P[3] *= 1.1;
    ASSERT_TRUE(step(set));
    EXPECT_EQ(s->live.motions.last()->resets, resets + 3);
  }
  expectNoJump();
}

TEST_F(LiveInput, MessagesThatCannotBeUsedAreNamedAndPassedOver) {
  reset();
  run(0, kWindow);
  const unsigned resets = s->live.motions.last()->resets;
  using Spoil = std::function<void(CameraSet&)>;
  using Case = std::pair<Spoil, std::vector<std::string>>;
  const std::vector<Case> named = {
      {[](CameraSet& set) { set.left = imageMessage(cv::Mat::zeros(120, 160, CV_8U)); },
       {"topic /left/image_rect", "160x120", "/left/camera_info", "320x240"}},
      {[](CameraSet& set) { set.right.encoding = "yuv9"; },
       {"topic /right/image_rect", "encoding 'yuv9'"}},
      {[](CameraSet& set) { set.left.data.resize(set.left.data.size() / 2); },
       {"topic /left/image_rect", "320x240", "cannot be read"}}};
  const std::vector<Spoil> refused = {
      [](CameraSet& set) { set.right = imageMessage(cv::Mat::zeros(120, 160, CV_8U)); },
      [](CameraSet& set) { set.left.step = 10; },
      [](CameraSet& set) {  // the product of the sizes overflows to that of the data
        set.left.width = set.left.height = set.left.step = 1U << 16;
        set.left.data.clear();
      },
      [](CameraSet& set) { set.left.width = 0; },
      [](CameraSet& set) { set.left.encoding.clear(); },
      [](CameraSet& set) { set.right.encoding = "32FC1"; },
      [](CameraSet& set) { set.left_info.P.fill(0); },
      [](CameraSet& set) { set.right_info.P[3] = std::nan(""); },
      [](CameraSet& set) { set.left_info.binning_x = 4000000000U; },
      [](CameraSet& set) { set.left_info.width = 0; }};
  const std::size_t before = s->live.motions.size();
  for (const auto& [spoil, parts] : named) {
    CameraSet set = frame(kWindow);
    spoil(set);
    publish(stamped(set));
    EXPECT_TRUE(eventually([&, wanted = parts] { return s->live.diagnostics.said(wanted); }, 10))
        << parts.back() << "\n"
        << s->live.diagnostics.message();
  }
  for (const Spoil& spoil : refused) {
    CameraSet set = frame(kWindow);
    spoil(set);
    publish(stamped(set));
  }
  const std::string count = std::to_string(named.size() + refused.size());
  EXPECT_TRUE(eventually([&] { return s->live.diagnostics.value("frames refused") == count; }, 10))
      << s->live.diagnostics.value("frames refused") << " of " << count
      << ", last: " << s->live.diagnostics.message();
  CameraSet nameless = stamped(frame(kWindow));
  nameless.left.header.frame_id.clear();
  publish(nameless);
  EXPECT_TRUE(eventually(
      [] {
        return s->live.diagnostics.said({"topic /left/image_rect", "frame_id is empty"});
      },
      10));
  EXPECT_EQ(s->live.motions.size(), before);
  run(kWindow, kWindow + 3);
  EXPECT_EQ(s->live.motions.last()->resets, resets);
  expectNoJump();
  expectAllKnown();
}

// Of the wrong size at first; then one that leaves out everything, and one that leaves out nothing.
TEST_F(LiveInput, AMaskIsTakenFromItsTopic) {
  reset();
  run(0, kWindow);
  ros::NodeHandle node;
  const ros::Publisher masks = node.advertise<sensor_msgs::Image>("/mask", 1, true);
  masks.publish(imageMessage(cv::Mat::ones(120, 160, CV_8U)));
  ASSERT_TRUE(eventually([&] { return masks.getNumSubscribers() > 0; }, 10));
  EXPECT_TRUE(publishingUntil(
      [] {
        return s->live.diagnostics.said({"topic /mask", "160x120", "320x240"});
      },
      [] { publish(stamped(frame(kWindow))); }, 10))
      << s->live.diagnostics.message();
  // A frame that meets the mask before is refused, so motions do not come of each.
  const auto until_lost_is = [](bool lost) {
    return publishingUntil([lost] { return s->live.motions.last()->lost == lost; },
                           [] { publish(stamped(frame(kWindow))); }, 10);
  };
  masks.publish(imageMessage(cv::Mat::zeros(240, 320, CV_8U)));
  EXPECT_TRUE(until_lost_is(true));
  masks.publish(imageMessage(cv::Mat::ones(240, 320, CV_8U)));
  EXPECT_TRUE(until_lost_is(false));
  EXPECT_TRUE(step(frame(kWindow)));
}

TEST_F(LiveInput, BlackImages) { expectLostAndFound(cv::Mat::zeros(240, 320, CV_8U)); }

TEST_F(LiveInput, SaturatedImages) {
  expectLostAndFound(cv::Mat(240, 320, CV_8U, cv::Scalar(255)));
}

TEST_F(LiveInput, TexturelessImages) {
  cv::Mat slope(240, 320, CV_8U);
  slope.forEach<unsigned char>([](unsigned char& pixel, const int* at) {
    pixel = static_cast<unsigned char>(at[1] * 2 / 5 + at[0] / 4);
  });
  expectLostAndFound(slope);
}

TEST_F(LiveInput, FrozenImagesAreNoticed) {
  reset();
  run(0, kWindow);
  for (int i = 0; i < 6; ++i) ASSERT_TRUE(step(frame(kWindow - 1)));
  EXPECT_TRUE(eventually([] { return s->live.diagnostics.said({"images are the same"}); }, 10));
  run(kWindow, 2 * kWindow);
  expectNoJump();
  expectAllKnown();
}

}  // namespace
}  // namespace mvo_ros
