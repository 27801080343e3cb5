// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A bag played in a loop: the clock and the stamps jump back, again and again.
#include <gtest/gtest.h>
#include <rosgraph_msgs/Clock.h>

#include "support/live_run.hpp"

namespace mvo_ros {
namespace {

using mvo::test::difference;
using mvo::test::eventually;
using mvo::test::isometry;

constexpr std::size_t kLoops = 10;
constexpr std::size_t kFrames = 16;

class LiveClock : public ::testing::Test {
 protected:
  LiveClock()
      : live_("/mvo", mvo::test::CameraTopics::stereo()),
        clock_(ros::NodeHandle().advertise<rosgraph_msgs::Clock>("/clock", 100)),
        recording_(mvo::test::recordBlocks(kFrames)) {}

  void SetUp() override {
    ASSERT_TRUE(eventually([this] { return clock_.getNumSubscribers() >= 2; }));  // node and test
    ASSERT_TRUE(live_.connected());
  }

  void tick(double seconds) {
    rosgraph_msgs::Clock message;
    message.clock = ros::Time(seconds);
    clock_.publish(message);
  }
  mvo::test::CameraSet setAt(std::size_t k, double seconds) {
    mvo::test::CameraSet set = mvo::test::stereoSet(recording_, k);
    stamp(set, ros::Time(seconds));
    return set;
  }
  static double secondsOf(std::size_t k) { return 50 + k / 15.0; }

  mvo::test::LiveRun live_;
  ros::Publisher clock_;
  mvo::test::Recording recording_;
};

TEST_F(LiveClock, EveryLoopStartsANewWorldAndFindsTheSame) {
  for (std::size_t loop = 0; loop < kLoops; ++loop)
    for (std::size_t k = 0; k < kFrames; ++k) {
      tick(secondsOf(k));
      ASSERT_TRUE(live_.step(setAt(k, secondsOf(k)))) << "loop " << loop << ", frame " << k;
    }
  const auto motions = live_.motions.all();
  const auto odometry = live_.odometry.all();
  ASSERT_EQ(motions.size(), kLoops * kFrames);
  mvo::test::expectNoJump(motions, odometry, 0.1);
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const mvo::MotionArray& now = *motions[i];
    const mvo::MotionArray& first = *motions[i % kFrames];
    EXPECT_EQ(now.resets, i / kFrames);
    EXPECT_EQ(now.header.stamp, first.header.stamp);
    // The first frames of a loop know as little and as much as those of the very first.
    ASSERT_EQ(now.lost, first.lost) << "loop " << i / kFrames << ", frame " << i % kFrames;
    ASSERT_EQ(now.motions.size(), first.motions.size());
    EXPECT_LE(now.window_begin, now.window_end);
    for (std::size_t m = 0; m < now.motions.size(); ++m) {
      EXPECT_EQ(now.motions[m].id, first.motions[m].id);
      EXPECT_EQ(now.motions[m].first_stamp, first.motions[m].first_stamp);
      EXPECT_LT(
          difference(isometry(now.motions[m].pose.pose), isometry(first.motions[m].pose.pose)),
          1e-9);
    }
  }
  EXPECT_FALSE(motions.back()->lost);
  EXPECT_EQ(mvo::test::bodies(*motions.back()), 4U);  // within one window, 12 frames
  EXPECT_TRUE(eventually([this] { return live_.diagnostics.value("resets") == "9"; }))
      << "diagnostics go on although the clock went back";
  EXPECT_TRUE(eventually([this] {
    return live_.log.said({"the world starts anew", "went back"});
  }));
}

// Messages that wait for their partners are from the future after a jump: they must not displace
// what comes.
TEST_F(LiveClock, LeftoversOfTheFutureDoNotBlockThePresent) {
  tick(100);
  ASSERT_TRUE(live_.step(setAt(0, 100)));
  const unsigned resets = live_.motions.last()->resets;
  for (std::size_t i = 1; i <= 30; ++i) live_.camera.publishLeft(setAt(0, 100 + 0.1 * i));
  tick(60);
  bool came = false;
  for (std::size_t k = 0; k < kFrames; ++k) {
    tick(60 + k / 15.0);
    if (live_.step(setAt(k, 60 + k / 15.0), 1)) came = true;
  }
  EXPECT_TRUE(came);
  EXPECT_EQ(live_.motions.last()->resets, resets + 1);
  EXPECT_FALSE(live_.motions.last()->lost);
}

}  // namespace
}  // namespace mvo_ros
