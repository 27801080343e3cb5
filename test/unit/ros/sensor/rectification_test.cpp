// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/rectification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"

namespace mvo_ros {
namespace {

using mvo::test::cameraInfo;
using mvo::test::errorOf;

// A smooth spot around a sub-pixel position.
cv::Mat spotAt(const cv::Point2d& center) {
  cv::Mat image(mvo::test::kHeight, mvo::test::kWidth, CV_8U);
  for (int y = 0; y < image.rows; ++y)
    for (int x = 0; x < image.cols; ++x) {
      const double r2 = std::pow(x - center.x, 2) + std::pow(y - center.y, 2);
      image.at<unsigned char>(y, x) = cv::saturate_cast<unsigned char>(250 * std::exp(-r2 / 18));
    }
  return image;
}

cv::Point2d centerOf(const cv::Mat& spot) {
  const cv::Moments m = cv::moments(spot);
  return {m.m10 / m.m00, m.m01 / m.m00};
}

// Where the raw camera sees a ray that the rectified camera sees at `rectified`, by OpenCV's
// forward projection, which is not what rectification uses.
cv::Point2d rawPixel(const sensor_msgs::CameraInfo& info, const cv::Point2d& rectified) {
  const cv::Matx33d R(info.R.data());
  const cv::Vec3d ray = R.t() * cv::Vec3d((rectified.x - info.P[2]) / info.P[0],
                                          (rectified.y - info.P[6]) / info.P[5], 1);
  const cv::Matx33d K(info.K.data());
  const std::vector<cv::Point3d> rays = {ray};
  std::vector<cv::Point2d> pixels;
  if (info.distortion_model == "equidistant")
    cv::fisheye::projectPoints(rays, pixels, cv::Affine3d::Identity(), K, info.D);
  else
    cv::projectPoints(rays, cv::Vec3d(), cv::Vec3d(), K, info.D, pixels);
  return pixels.front();
}

void expectRectifies(const sensor_msgs::CameraInfo& info, double least_shift) {
  const Rectification rectification(info, "/info");
  for (const cv::Point2d target : {cv::Point2d(60, 50), cv::Point2d(250, 180)}) {
    const cv::Point2d raw = rawPixel(info, target);
    EXPECT_GT(cv::norm(raw - target), least_shift);  // there is something to rectify
    const cv::Point2d found = centerOf(rectification.grey(spotAt(raw)));
    EXPECT_NEAR(found.x, target.x, 0.25);
    EXPECT_NEAR(found.y, target.y, 0.25);
  }
}

TEST(Rectification, UndoesDistortion) {
  sensor_msgs::CameraInfo info = cameraInfo(0);
  info.D = {-0.25, 0.08, 0.001, -0.001, 0};
  expectRectifies(info, 2);
}

TEST(Rectification, RotatesAlsoWithoutDistortion) {
  sensor_msgs::CameraInfo info = cameraInfo(0);
  const double a = 0.03;
  info.R = {std::cos(a), -std::sin(a), 0, std::sin(a), std::cos(a), 0, 0, 0, 1};
  expectRectifies(info, 2);
}

TEST(Rectification, KnowsFisheyeLenses) {
  sensor_msgs::CameraInfo info = cameraInfo(0);
  info.distortion_model = "equidistant";
  info.D = {0.02, -0.01, 0.002, 0.0};
  expectRectifies(info, 2);
}

TEST(Rectification, LeavesARectifiedImageAsItIs) {
  const cv::Mat image = mvo::test::slidingView(0, 0);
  const cv::Mat same = Rectification(cameraInfo(0), "/info").grey(image);
  EXPECT_EQ(cv::countNonZero(image != same), 0);
}

TEST(Rectification, NeverMixesDepthsAndLeavesHolesOutside) {
  sensor_msgs::CameraInfo info = cameraInfo(0);
  info.P[2] += 40.4;  // the left columns see nothing
  cv::Mat depth(mvo::test::kHeight, mvo::test::kWidth, CV_32F, cv::Scalar(1));
  depth.colRange(100, depth.cols).setTo(5);
  const cv::Mat out = Rectification(info, "/info").depth(depth);
  EXPECT_TRUE(std::isnan(out.at<float>(10, 10)));
  EXPECT_EQ(out.at<float>(10, 130), 1);
  EXPECT_EQ(out.at<float>(10, 150), 5);
  int mixed = 0;
  for (const float z : cv::Mat_<float>(out)) mixed += !std::isnan(z) && z != 1 && z != 5;
  EXPECT_EQ(mixed, 0);
}

TEST(Rectification, RefusesWhatItCannotUndo) {
  const auto errorWith = [](const auto& change) {
    sensor_msgs::CameraInfo info = cameraInfo(0);
    change(info);
    return errorOf([&info] { Rectification(info, "/info"); });
  };
  EXPECT_EQ(
      errorWith([](auto& info) { info.K.fill(0); }).find("topic /info: the focal lengths K[0]"),
      0U);
  const std::string unknown = errorWith([](auto& info) { info.distortion_model = "bent"; });
  EXPECT_NE(unknown.find("'bent' is unknown"), std::string::npos) << unknown;
  const std::string three = errorWith([](auto& info) { info.D = {0.1, 0.2, 0.3}; });
  EXPECT_NE(three.find("does not go with 3 coefficients"), std::string::npos) << three;
}

}  // namespace
}  // namespace mvo_ros
