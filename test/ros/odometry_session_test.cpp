// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "odometry_session.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>

namespace mvo_ros {
namespace {

sensor_msgs::ImageConstPtr imageAt(double stamp, unsigned width, unsigned height,
                                   std::uint8_t grey) {
  auto image = boost::make_shared<sensor_msgs::Image>();
  image->header.stamp.fromSec(stamp);
  image->header.frame_id = "cam";
  image->encoding = sensor_msgs::image_encodings::MONO8;
  image->width = width;
  image->height = height;
  image->step = width;
  image->data.assign(static_cast<std::size_t>(width) * height, grey);
  return image;
}

sensor_msgs::CameraInfoConstPtr infoOf(unsigned width, unsigned height, double baseline,
                                       double focal_length = 200) {
  auto info = boost::make_shared<sensor_msgs::CameraInfo>();
  info->width = width;
  info->height = height;
  const double f = focal_length;
  info->K = {f, 0, width / 2.0, 0, f, height / 2.0, 0, 0, 1};
  info->R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info->P = {f, 0, width / 2.0, -f * baseline, 0, f, height / 2.0, 0, 0, 0, 1, 0};
  return info;
}

InputSet setAt(double stamp, unsigned width = 160, unsigned height = 120) {
  static std::uint8_t grey = 100;
  ++grey;  // no two frames alike
  return {imageAt(stamp, width, height, grey), imageAt(stamp, width, height, grey),
          infoOf(width, height, 0), infoOf(width, height, 0.2), ros::WallTime()};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class OdometrySessionTest : public ::testing::Test {
 protected:
  std::string refusalOf(const InputSet& set) {
    try {
      session_.add(set);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  OdometrySession session_{SensorSetup(), mvo::Options()};
};

TEST_F(OdometrySessionTest, ClocksThatJumpBackStartANewWorld) {
  EXPECT_FALSE(session_.add(setAt(10)).restarted);
  EXPECT_EQ(session_.add(setAt(10.1)).resets, 0U);
  const Step step = session_.add(setAt(3));
  EXPECT_TRUE(step.restarted);
  EXPECT_EQ(step.resets, 1U);
  EXPECT_TRUE(has(step.notice, "time went back by 7.1")) << step.notice;
  EXPECT_EQ(step.estimate.frame, 0);
  EXPECT_FALSE(step.period);
  EXPECT_FALSE(session_.add(setAt(3.1)).restarted);
}

TEST_F(OdometrySessionTest, ARepeatedStampIsPassedOver) {
  session_.add(setAt(10));
  EXPECT_TRUE(has(refusalOf(setAt(10)), "a second image")) << refusalOf(setAt(10));
  EXPECT_EQ(session_.add(setAt(10.1)).estimate.frame, 1);
}

TEST_F(OdometrySessionTest, ANewCalibrationStartsANewWorld) {
  session_.add(setAt(10));
  const Step larger = session_.add(setAt(10.1, 320, 240));
  EXPECT_TRUE(larger.restarted);
  EXPECT_TRUE(has(larger.notice, "calibration")) << larger.notice;
  EXPECT_EQ(larger.camera.width, 320);
  InputSet other = setAt(10.2, 320, 240);
  other.left_info = infoOf(320, 240, 0, 210);
  other.second_info = infoOf(320, 240, 0.2, 210);
  EXPECT_EQ(session_.add(other).resets, 2U);
}

TEST_F(OdometrySessionTest, WhatCannotBeUsedIsNamedAndForgotten) {
  session_.add(setAt(10));
  InputSet size = setAt(10.1);
  size.second = imageAt(10.1, 80, 60, 1);
  EXPECT_TRUE(has(refusalOf(size), "/stereo/right/image_rect: the image has 80x60 pixels"))
      << refusalOf(size);
  InputSet baseline = setAt(10.1);
  baseline.second_info = infoOf(160, 120, 0);
  EXPECT_TRUE(has(refusalOf(baseline), "/stereo/right/camera_info")) << refusalOf(baseline);
  const Step step = session_.add(setAt(10.2));
  EXPECT_EQ(step.estimate.frame, 1);
  EXPECT_EQ(step.resets, 0U);
}

TEST_F(OdometrySessionTest, GapsAndFrozenImagesAreSaid) {
  session_.add(setAt(10));
  EXPECT_TRUE(has(session_.add(setAt(14.5)).notice, "no images for 4.5"));
  InputSet same = setAt(15);
  std::string notice;
  for (int i = 0; i < 5; ++i) {
    InputSet again = same;
    auto left = boost::make_shared<sensor_msgs::Image>(*same.left);
    left->header.stamp.fromSec(15 + 0.1 * i);
    again.left = left;
    notice = session_.add(again).notice;
  }
  EXPECT_TRUE(has(notice, "the last 5 images are the same")) << notice;
}

TEST_F(OdometrySessionTest, AResetIsCarriedOutWithTheNextFrame) {
  session_.reset("too early");  // nothing to forget yet
  EXPECT_EQ(session_.add(setAt(10)).resets, 0U);
  session_.reset("asked for by service");
  const Step step = session_.add(setAt(10.1));
  EXPECT_EQ(step.resets, 1U);
  EXPECT_TRUE(has(step.notice, "asked for by service"));
}

}  // namespace
}  // namespace mvo_ros
