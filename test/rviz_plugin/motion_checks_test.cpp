// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/motion_checks.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace mvo_rviz {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

mvo::Motion goodMotion() {
  mvo::Motion motion;
  motion.id = 3;
  motion.state = mvo::Motion::TRACKED;
  motion.pose.pose.orientation.w = 1;
  motion.pose.covariance.fill(9999);
  motion.trajectory.resize(2);
  motion.trajectory[0].header.frame_id = "odom";
  return motion;
}

TEST(MotionChecks, GoodMessagesPass) {
  mvo::MotionArray array;
  array.header.frame_id = "odom";
  EXPECT_EQ(problemOf(array), "");
  EXPECT_EQ(problemOf(goodMotion(), "odom"), "");
}

TEST(MotionChecks, AnArrayNeedsAFrame) {
  EXPECT_NE(problemOf(mvo::MotionArray()).find("header.frame_id"), std::string::npos);
}

TEST(MotionChecks, RoundingOfAQuaternionPasses) {
  mvo::Motion motion = goodMotion();
  motion.pose.pose.orientation.w = 1.001;
  EXPECT_EQ(problemOf(motion, "odom"), "");
}

struct Defect {
  std::string field;
  std::function<void(mvo::Motion&)> make;
};

class MotionDefects : public testing::TestWithParam<Defect> {};

TEST_P(MotionDefects, IdAndFieldAreNamed) {
  mvo::Motion motion = goodMotion();
  GetParam().make(motion);
  const std::string problem = problemOf(motion, "odom");
  EXPECT_EQ(problem.find("Motion " + std::to_string(motion.id) + ": " + GetParam().field + " "), 0U)
      << problem;
}

INSTANTIATE_TEST_SUITE_P(
    All, MotionDefects,
    testing::Values(
        Defect{"id", [](auto& m) { m.id = -1; }}, Defect{"state", [](auto& m) { m.state = 5; }},
        Defect{"pose.pose.position", [](auto& m) { m.pose.pose.position.y = kNan; }},
        Defect{"pose.pose.position", [](auto& m) { m.pose.pose.position.z = 1e300; }},
        Defect{"pose.pose.orientation", [](auto& m) { m.pose.pose.orientation.w = 0; }},
        Defect{"pose.pose.orientation", [](auto& m) { m.pose.pose.orientation.x = 1; }},
        Defect{"pose.pose.orientation", [](auto& m) { m.pose.pose.orientation.x = kNan; }},
        Defect{"pose.covariance", [](auto& m) { m.pose.covariance[35] = kInfinity; }},
        Defect{"twist.twist.linear", [](auto& m) { m.twist.twist.linear.x = -kInfinity; }},
        Defect{"extent_center", [](auto& m) { m.extent_center.x = kNan; }},
        Defect{"extent", [](auto& m) { m.extent.z = -0.1; }},
        Defect{"extent", [](auto& m) { m.extent.z = kNan; }},
        Defect{"trajectory[1].pose.position",
               [](auto& m) { m.trajectory[1].pose.position.x = kNan; }},
        Defect{"trajectory[0].header.frame_id",
               [](auto& m) { m.trajectory[0].header.frame_id = "map"; }}));

}  // namespace
}  // namespace mvo_rviz
