// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "edges/overlay.hpp"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "edges/motion_color.hpp"

namespace mvo_ros {
namespace {

constexpr int kWidth = 960;  // drawn at its own scale
constexpr int kHeight = 300;

cv::Vec3b pixel(const cv::Mat& picture, int x, int y) { return picture.at<cv::Vec3b>(y, x); }

cv::Vec3b pixelOf(mvo::LabelId id) {
  const auto [red, green, blue] = mvo::motionColor(id);
  return {blue, green, red};
}

mvo::LabeledPoint point(mvo::TrackletId tracklet, double u, double v, mvo::LabelId id) {
  mvo::LabeledPoint p;
  p.tracklet = tracklet;
  p.y = {u, v, u - 5};
  p.id = id;
  return p;
}

mvo::MultimotionEstimate estimateWith(mvo::FrameId frame,
                                      const std::vector<mvo::LabeledPoint>& points) {
  mvo::MultimotionEstimate estimate;
  estimate.frame = frame;
  estimate.valid = true;
  estimate.points = points;
  return estimate;
}

TEST(Overlay, MotionsHaveTheirOwnColours) {
  std::set<std::array<std::uint8_t, 3>> colors;
  for (mvo::LabelId id = mvo::kOutlier; id <= 10; ++id) colors.insert(mvo::motionColor(id));
  EXPECT_EQ(colors.size(), 12U);
  EXPECT_EQ(mvo::motionColor(3), mvo::motionColor(13));  // ten, then again from the first
}

TEST(Overlay, DrawsEachPointInTheColourOfItsLabel) {
  Overlay overlay({kWidth, kHeight});
  const cv::Mat black = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  const cv::Mat picture = overlay.draw(
      black, estimateWith(0, {point(1, 100, 50, 0), point(2, 300, 50, 2), point(3, 500, 50, -1)}));
  EXPECT_EQ(picture.size(), overlay.size());
  EXPECT_EQ(pixel(picture, 100, 50), pixelOf(mvo::kStatic));
  EXPECT_EQ(pixel(picture, 300, 50), pixelOf(2));
  EXPECT_EQ(pixel(picture, 500, 50), pixelOf(mvo::kOutlier));
  EXPECT_EQ(pixel(picture, 700, 50), cv::Vec3b(0, 0, 0));
}

TEST(Overlay, TailsShowWhereMovingPointsCameFrom) {
  Overlay overlay({kWidth, kHeight});
  const cv::Mat black = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  cv::Mat picture;
  for (int k = 0; k < 15; ++k)
    picture = overlay.draw(black, estimateWith(k, {point(1, 100 + 20.0 * k, 200, 1),
                                                   point(2, 100 + 20.0 * k, 100, 0)}));
  // Now at column 380; the tail's ten observations begin at 200.
  EXPECT_NE(pixel(picture, 370, 200), cv::Vec3b(0, 0, 0));
  EXPECT_NE(pixel(picture, 205, 200), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(pixel(picture, 190, 200), cv::Vec3b(0, 0, 0));
  EXPECT_EQ(pixel(picture, 370, 100), cv::Vec3b(0, 0, 0));  // none for the static world
}

TEST(Overlay, SmallImagesAreEnlargedAndSizesAreEven) {
  EXPECT_EQ(Overlay({640, 480}).size(), cv::Size(1280, 992));
  EXPECT_EQ(Overlay({1241, 376}).size(), cv::Size(1242, 408));
  const cv::Mat white(480, 640, CV_8U, cv::Scalar(255));
  const cv::Mat picture = Overlay({640, 480}).draw(white, estimateWith(0, {point(1, 10, 20, 1)}));
  // The centre of pixel (10, 20) lies between four pixels of the enlarged picture.
  EXPECT_EQ(pixel(picture, 20, 40), pixelOf(1));
  EXPECT_EQ(pixel(picture, 21, 41), pixelOf(1));
}

TEST(Overlay, SaysWhyThereIsNoEstimate) {
  Overlay overlay({kWidth, kHeight});
  const cv::Mat black = cv::Mat::zeros(kHeight, kWidth, CV_8U);
  mvo::MultimotionEstimate lost;
  lost.problem = "too dark";
  const cv::Mat legend = overlay.draw(black, lost).rowRange(kHeight, kHeight + 32);
  cv::Mat red;
  cv::inRange(legend, cv::Scalar(0, 0, 150), cv::Scalar(110, 110, 255), red);
  EXPECT_GT(cv::countNonZero(red), 50);
}

}  // namespace
}  // namespace mvo_ros
