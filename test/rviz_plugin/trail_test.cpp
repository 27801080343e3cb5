// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/trail.hpp"

#include <gtest/gtest.h>

namespace mvo_rviz {
namespace {

std::vector<geometry_msgs::PoseStamped> posesAlongX(std::size_t count) {
  std::vector<geometry_msgs::PoseStamped> poses(count);
  for (std::size_t i = 0; i < count; ++i) poses[i].pose.position.x = static_cast<double>(i);
  return poses;
}

TEST(Trail, ZeroTakesTheWholeWindow) {
  const auto trail = cutTrail(posesAlongX(48), 0);
  ASSERT_EQ(trail.size(), 48U);
  EXPECT_EQ(trail.front(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(trail.back(), Eigen::Vector3d(47, 0, 0));
}

TEST(Trail, ALengthKeepsTheNewestPoses) {
  const auto trail = cutTrail(posesAlongX(48), 3);
  ASSERT_EQ(trail.size(), 3U);
  EXPECT_EQ(trail.front().x(), 45);
  EXPECT_EQ(trail.back().x(), 47);
}

TEST(Trail, ShortTrajectoriesAreTakenWhole) {
  EXPECT_EQ(cutTrail(posesAlongX(2), 10).size(), 2U);
  EXPECT_TRUE(cutTrail({}, 10).empty());
  EXPECT_TRUE(cutTrail({}, 0).empty());
}

TEST(Trail, NoTrailIsLongerThanALineOfBillboards) {
  const auto poses = posesAlongX(kLongestTrail + 5);
  for (const int length : {0, kLongestTrail + 5}) {
    const auto trail = cutTrail(poses, length);
    ASSERT_EQ(trail.size(), static_cast<std::size_t>(kLongestTrail));
    EXPECT_EQ(trail.front().x(), 5);
  }
}

}  // namespace
}  // namespace mvo_rviz
