// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/odometry_session.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <boost/make_shared.hpp>
#include <chrono>
#include <future>
#include <thread>

#include "support/simulated_camera.hpp"

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
      add(set);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  Step add(const InputSet& set) { return session_.add(preparation_.prepare(set)); }

  SetPreparation preparation_{SensorSetup(), mvo::Options()};
  OdometrySession session_{SensorSetup().topics, mvo::Options()};
};

TEST_F(OdometrySessionTest, ClocksThatJumpBackStartANewWorld) {
  EXPECT_FALSE(add(setAt(10)).restarted);
  EXPECT_EQ(add(setAt(10.1)).resets, 0U);
  const Step step = add(setAt(3));
  EXPECT_TRUE(step.restarted);
  EXPECT_EQ(step.resets, 1U);
  EXPECT_TRUE(has(step.notice, "time went back by 7.1")) << step.notice;
  EXPECT_EQ(step.estimate.frame, 0);
  EXPECT_FALSE(step.period);
  EXPECT_FALSE(add(setAt(3.1)).restarted);
}

TEST_F(OdometrySessionTest, StartsFromWhatIsKnownOfThePair) {
  mvo::LearntCameraErrors known = add(setAt(10)).camera_errors->learnt;
  known.mean[0] = 1e-3;
  known.covariance *= 1e-2;
  SetPreparation preparation{SensorSetup(), mvo::Options()};
  preparation.setCameraErrors(known, "option camera_errors: pair.json");
  OdometrySession session(SensorSetup().topics, mvo::Options());
  const InputSet set = setAt(10);
  const Step step = session.add(preparation.prepare(set));
  ASSERT_TRUE(step.camera_errors);
  EXPECT_NEAR(step.camera_errors->learnt.mean[0], 1e-3, 1e-5);
  EXPECT_EQ(step.left_info, set.left_info);
  EXPECT_EQ(step.second_info, set.second_info);
  // Of another size.
  try {
    preparation.prepare(setAt(10.1, 320, 240));
    FAIL() << "no exception";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(has(error.what(),
                    "option camera_errors: pair.json: the camera errors belong to "
                    "another camera: its width is 160, this camera's is 320"))
        << error.what();
  }
  EXPECT_EQ(session.add(preparation.prepare(setAt(10.2))).estimate.frame, 1);
}

TEST_F(OdometrySessionTest, ARepeatedStampIsPassedOver) {
  add(setAt(10));
  EXPECT_TRUE(has(refusalOf(setAt(10)), "a second image")) << refusalOf(setAt(10));
  EXPECT_EQ(add(setAt(10.1)).estimate.frame, 1);
}

TEST_F(OdometrySessionTest, ANewCalibrationStartsANewWorld) {
  add(setAt(10));
  const Step larger = add(setAt(10.1, 320, 240));
  EXPECT_TRUE(larger.restarted);
  EXPECT_TRUE(has(larger.notice, "calibration")) << larger.notice;
  EXPECT_EQ(larger.camera.width, 320);
  InputSet other = setAt(10.2, 320, 240);
  other.left_info = infoOf(320, 240, 0, 210);
  other.second_info = infoOf(320, 240, 0.2, 210);
  EXPECT_EQ(add(other).resets, 2U);
}

TEST_F(OdometrySessionTest, WhatCannotBeUsedIsNamedAndForgotten) {
  add(setAt(10));
  InputSet size = setAt(10.1);
  size.second = imageAt(10.1, 80, 60, 1);
  EXPECT_TRUE(has(refusalOf(size), "/stereo/right/image_rect: the image has 80x60 pixels"))
      << refusalOf(size);
  InputSet baseline = setAt(10.1);
  baseline.second_info = infoOf(160, 120, 0);
  EXPECT_TRUE(has(refusalOf(baseline), "/stereo/right/camera_info")) << refusalOf(baseline);
  const Step step = add(setAt(10.2));
  EXPECT_EQ(step.estimate.frame, 1);
  EXPECT_EQ(step.resets, 0U);
}

TEST_F(OdometrySessionTest, MasksOfAnotherSizeAreNamedAndMayBeReplaced) {
  preparation_.setMask({cv::Mat(480, 640, CV_8U, cv::Scalar(1)), "topic /mask"});
  EXPECT_EQ(refusalOf(setAt(10)),
            "topic /mask: has 640x480 pixels, but the left image has 160x120");
  preparation_.setMask({cv::Mat(120, 160, CV_8U, cv::Scalar(1)), "topic /mask"});
  EXPECT_EQ(refusalOf(setAt(10.1)), "");
}

TEST_F(OdometrySessionTest, GapsAndFrozenImagesAreSaid) {
  add(setAt(10));
  EXPECT_TRUE(has(add(setAt(14.5)).notice, "no images for 4.5"));
  InputSet same = setAt(15);
  std::string notice;
  for (int i = 0; i < 5; ++i) {
    InputSet again = same;
    auto left = boost::make_shared<sensor_msgs::Image>(*same.left);
    left->header.stamp.fromSec(15 + 0.1 * i);
    again.left = left;
    notice = add(again).notice;
  }
  EXPECT_TRUE(has(notice, "the last 5 images are the same")) << notice;
}

TEST_F(OdometrySessionTest, AResetIsCarriedOutWithTheNextFrame) {
  session_.reset("too early");  // nothing to forget yet
  EXPECT_EQ(add(setAt(10)).resets, 0U);
  session_.reset("asked for by service");
  const Step step = add(setAt(10.1));
  EXPECT_EQ(step.resets, 1U);
  EXPECT_TRUE(has(step.notice, "asked for by service"));
}

TEST_F(OdometrySessionTest, CalibrationsPreparedAheadTakeTheirTurn) {
  PreparedSet first = preparation_.prepare(setAt(10));
  PreparedSet second = preparation_.prepare(setAt(10.1, 320, 240));
  PreparedSet third = preparation_.prepare(setAt(10.2, 320, 240));
  mvo::Options fewer;
  fewer.frontend.max_features = 20;
  session_.setOptions(fewer);  // after the second's calibration was adopted
  EXPECT_EQ(session_.add(std::move(first)).camera.width, 160);
  const Step larger = session_.add(std::move(second));
  EXPECT_TRUE(larger.restarted);
  EXPECT_EQ(larger.camera.width, 320);
  EXPECT_FALSE(session_.add(std::move(third)).restarted);
}

TEST_F(OdometrySessionTest, TimeOfWorkIsWhoeversWorkNotWaiting) {
  using Clock = std::chrono::steady_clock;
  using Milliseconds = std::chrono::duration<double, std::milli>;
  const InputSet input = setAt(10);
  const auto begin = Clock::now();
  PreparedSet set = preparation_.prepare(input);
  const Milliseconds preparing = Clock::now() - begin;
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto end_of_wait = Clock::now();
  const Step step = session_.add(std::move(set));
  const Milliseconds adding = Clock::now() - end_of_wait;
  EXPECT_GT(step.decode_ms, 0);
  EXPECT_GE(step.before_ms, step.decode_ms);
  EXPECT_GT(step.total_ms, step.before_ms);
  EXPECT_LE(step.total_ms, (preparing + adding).count()) << "the work, however slow the machine is";
}

std::vector<InputSet> recordedSets() {
  const auto recording = mvo::test::recordBlocks(12);
  std::vector<InputSet> sets;
  for (std::size_t k = 0; k < recording.frames.size(); ++k) {
    mvo::test::CameraSet set = mvo::test::stereoSet(recording, k);
    stamp(set, ros::Time(10 + 0.1 * static_cast<double>(k)));
    sets.push_back({boost::make_shared<sensor_msgs::Image>(set.left),
                    boost::make_shared<sensor_msgs::Image>(set.right),
                    boost::make_shared<sensor_msgs::CameraInfo>(set.left_info),
                    boost::make_shared<sensor_msgs::CameraInfo>(set.right_info), ros::WallTime()});
  }
  return sets;
}

TEST_F(OdometrySessionTest, PreparingTheNextMeanwhileChangesNoBit) {
  const std::vector<InputSet> sets = recordedSets();
  std::vector<mvo::MultimotionEstimate> in_turn;
  for (const InputSet& set : sets) in_turn.push_back(add(set).estimate);

  SetPreparation preparation{SensorSetup(), mvo::Options()};
  OdometrySession session{SensorSetup().topics, mvo::Options()};
  PreparedSet next = preparation.prepare(sets.front());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    PreparedSet now = std::move(next);
    auto ahead = std::async(std::launch::async, [&] {
      return preparation.prepare(sets[std::min(k + 1, sets.size() - 1)]);
    });
    const mvo::MultimotionEstimate estimate = session.add(std::move(now)).estimate;
    next = ahead.get();
    ASSERT_EQ(estimate.motions.size(), in_turn[k].motions.size());
    for (std::size_t m = 0; m < estimate.motions.size(); ++m)
      EXPECT_EQ(estimate.motions[m].T_world_motion.matrix(),
                in_turn[k].motions[m].T_world_motion.matrix());
    ASSERT_EQ(estimate.points.size(), in_turn[k].points.size());
    for (std::size_t p = 0; p < estimate.points.size(); ++p) {
      EXPECT_EQ(estimate.points[p].id, in_turn[k].points[p].id);
      EXPECT_EQ(estimate.points[p].y, in_turn[k].points[p].y);
    }
  }
}

}  // namespace
}  // namespace mvo_ros
