// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/camera_error_outputs.hpp"

#include <gtest/gtest.h>

#include "frontend/camera/error_report.hpp"

namespace mvo_ros {
namespace {

const mvo::StereoCamera kCamera{700, 700, 320, 240, 0.2, 640, 480};

mvo::CameraErrorReport squinting(double turn) {
  mvo::ErrorEstimate estimate = mvo::expectedErrors(kCamera);
  estimate.covariance *= 1e-4;
  estimate.mean[mvo::kTurn] = turn;
  return mvo::errorReport(kCamera, estimate);
}

mvo::CameraErrors messageAt(double stamp, double turn) {
  std_msgs::Header header;
  header.stamp.fromSec(stamp);
  header.frame_id = "left_optical";
  return cameraErrorsMessage(header, squinting(turn));
}

TEST(CameraErrorOutputs, TheMessageSaysAll) {
  const mvo::CameraErrorReport report = squinting(-2e-3);
  const mvo::CameraErrors message = messageAt(5, -2e-3);
  EXPECT_EQ(message.header.frame_id, "left_optical");
  EXPECT_TRUE(message.significant);
  EXPECT_EQ(message.advice, report.advice);
  EXPECT_NEAR(message.disparity, 1.4, 1e-9);
  EXPECT_EQ(message.disparity_sd, report.disparity.deviation);
  EXPECT_EQ(message.rows_rms, report.rows_rms.value);
  EXPECT_GT(message.yaw, 0.1);
  EXPECT_EQ(message.delay_sd, report.delay.deviation);
  const std::size_t terms = mvo::kErrorTerms;
  ASSERT_EQ(message.terms.size(), terms);
  EXPECT_EQ(message.units.size(), terms);
  ASSERT_EQ(message.covariance.size(), terms * terms);
  EXPECT_EQ(message.terms[mvo::kTurn], "turn");
  EXPECT_EQ(message.values[mvo::kTurn], -2e-3);
  EXPECT_EQ(message.covariance[mvo::kTurn * terms + mvo::kTurn],
            report.learnt.covariance(mvo::kTurn, mvo::kTurn));
}

TEST(CameraErrorOutputs, TheSameIsSaidAgainAfterAWhileOnly) {
  const mvo::CameraErrors last = messageAt(5, -2e-3);
  EXPECT_FALSE(isWorthSaying(messageAt(5.1, -2e-3), last));
  EXPECT_FALSE(isWorthSaying(messageAt(5.1, -2.05e-3), last));
  EXPECT_TRUE(isWorthSaying(messageAt(5.1, -2.1e-3), last)) << "0.07 px more";
  EXPECT_TRUE(isWorthSaying(messageAt(7.1, -2e-3), last));
  EXPECT_TRUE(isWorthSaying(messageAt(1, -2e-3), last)) << "the clock went back";
  mvo::CameraErrors unsure = last;
  unsure.significant = 0;
  EXPECT_TRUE(isWorthSaying(unsure, last));
}

}  // namespace
}  // namespace mvo_ros
