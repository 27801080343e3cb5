// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// main() of the tests that run as a ROS node beside the node under test.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test");
  const ros::NodeHandle nh;  // keeps the connection to the master between tests
  ros::AsyncSpinner spinner(2);
  spinner.start();
  const int result = RUN_ALL_TESTS();
  // rostest reads nothing but the results, where a suite whose set-up failed is only skipped; it
  // takes notice when there are none.
  const std::string output = testing::GTEST_FLAG(output);
  if (result != 0 && testing::UnitTest::GetInstance()->failed_test_count() == 0 &&
      output.rfind("xml:", 0) == 0)
    std::remove(output.substr(4).c_str());
  return result;
}
