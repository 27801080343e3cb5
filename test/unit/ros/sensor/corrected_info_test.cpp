// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A right camera that is not where its calibration has it: the corrected calibration is its own.
#include "ros/sensor/corrected_info.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/calib3d.hpp>

#include "frontend/camera/learnt_errors.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"

namespace mvo_ros {
namespace {

using mvo::test::cameraInfo;
using mvo::test::errorOf;
using mvo::test::kBaseline;
using mvo::test::kHeight;
using mvo::test::kWidth;
using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

mvo::StereoCamera camera() {
  const auto info = cameraInfo(kBaseline);
  return {info.P[0], info.P[5], info.P[2], info.P[6], kBaseline, kWidth, kHeight};
}

mvo::LearntCameraErrors learnt(const mvo::ErrorVector& errors) {
  return mvo::learntErrors(camera(), {errors, mvo::expectedErrors(camera()).covariance});
}

Eigen::Matrix3d turned(const Eigen::Vector3d& omega) {
  return Eigen::AngleAxisd(omega.norm(), omega.normalized()).toRotationMatrix();
}

// Where the raw image has what the rectified camera sees at a pixel.
cv::Point2d rawPixel(const sensor_msgs::CameraInfo& info, const cv::Point2d& rectified) {
  const cv::Matx33d R(info.R.data());
  const std::vector<cv::Point3d> rays = {R.t() * cv::Vec3d((rectified.x - info.P[2]) / info.P[0],
                                                           (rectified.y - info.P[6]) / info.P[5],
                                                           1)};
  const cv::Matx33d K(info.K.data());
  std::vector<cv::Point2d> pixels;
  if (info.distortion_model == "equidistant")
    cv::fisheye::projectPoints(rays, pixels, cv::Affine3d::Identity(), K, info.D);
  else
    cv::projectPoints(rays, cv::Vec3d(), cv::Vec3d(), K, info.D, pixels);
  return pixels.front();
}

// Largest distance of two calibrations' raw pixels.
double distance(const sensor_msgs::CameraInfo& a, const sensor_msgs::CameraInfo& b) {
  double largest = 0;
  for (const double u : {10.0, 160.0, 310.0})
    for (const double v : {10.0, 120.0, 230.0})
      largest = std::max(largest, cv::norm(rawPixel(a, {u, v}) - rawPixel(b, {u, v})));
  return largest;
}

// A lens that distorts, in a camera that is turned against the baseline.
sensor_msgs::CameraInfo claimed() {
  sensor_msgs::CameraInfo info = cameraInfo(kBaseline);
  info.D = {-0.25, 0.08, 0.001, -0.001, 0};
  Eigen::Map<RowMajor> R(info.R.data());
  R = turned({0.01, -0.02, 0.015});
  return info;
}

void expectFindsTheMounting(const sensor_msgs::CameraInfo& info) {
  const Eigen::Vector3d omega(0.0015, -0.003, 0.002);  // of what is seen
  mvo::ErrorVector errors = mvo::ErrorVector::Zero();
  errors[mvo::kTilt] = -omega.x();
  errors[mvo::kTurn] = omega.y();
  errors[mvo::kRoll] = omega.z();
  sensor_msgs::CameraInfo truth = info;
  Eigen::Map<RowMajor> R(truth.R.data());
  R = turned(-omega) * RowMajor(R);
  const CorrectedInfo corrected = correctedRight(info, learnt(errors));
  EXPECT_GT(distance(info, truth), 0.5);
  EXPECT_LT(distance(corrected.right, truth), 0.02);
  EXPECT_GT(corrected.before_rms, 0.5);
  EXPECT_LT(corrected.after_rms, 0.01);
  EXPECT_EQ(corrected.right.P, info.P);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(corrected.right.R[i], truth.R[i], 2e-4) << i;
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(corrected.right.K[i], info.K[i], 0.1) << i;
}

TEST(CorrectedInfo, FindsTheMounting) {
  expectFindsTheMounting(cameraInfo(kBaseline));
  expectFindsTheMounting(claimed());
  sensor_msgs::CameraInfo fisheye = claimed();
  fisheye.distortion_model = "equidistant";
  fisheye.D = {0.02, -0.01, 0.002, 0.0};
  expectFindsTheMounting(fisheye);
}

TEST(CorrectedInfo, FindsTheFocalLengthAndTheLens) {
  mvo::ErrorVector errors = mvo::ErrorVector::Zero();
  errors[mvo::kScale] = 4e-3;
  const sensor_msgs::CameraInfo info = cameraInfo(kBaseline);
  CorrectedInfo corrected = correctedRight(info, learnt(errors));
  EXPECT_NEAR(corrected.right.K[0], 1.004 * info.K[0], 0.02);
  EXPECT_NEAR(corrected.right.K[4], 1.004 * info.K[4], 0.02);
  EXPECT_LT(corrected.after_rms, 0.01);

  errors = mvo::ErrorVector::Zero();
  errors[mvo::kRadial] = 5e-3;
  errors[mvo::kTangentialU] = 2e-3;  // p2
  errors[mvo::kTangentialV] = 1e-3;  // p1
  corrected = correctedRight(info, learnt(errors));
  EXPECT_NEAR(corrected.right.D[0], 5e-3, 5e-4);
  EXPECT_NEAR(corrected.right.D[2], 1e-3, 3e-4);
  EXPECT_NEAR(corrected.right.D[3], 2e-3, 3e-4);
  EXPECT_LT(corrected.after_rms, 0.01);
}

TEST(CorrectedInfo, SaysWhatItCannotCorrect) {
  mvo::ErrorVector errors = mvo::ErrorVector::Zero();
  errors[mvo::kShear] = 4e-3;
  const CorrectedInfo corrected = correctedRight(cameraInfo(kBaseline), learnt(errors));
  EXPECT_GT(corrected.after_rms, 0.1);
  EXPECT_LE(corrected.after_rms, corrected.before_rms);
}

TEST(CorrectedInfo, NoErrorNoChange) {
  const CorrectedInfo corrected = correctedRight(claimed(), learnt(mvo::ErrorVector::Zero()));
  EXPECT_EQ(corrected.right, claimed());
  EXPECT_EQ(corrected.before_rms, 0);
  EXPECT_EQ(corrected.after_rms, 0);
}

TEST(CorrectedInfo, TakesCalibrationsThatSayTheRectifiedCameraOnly) {
  sensor_msgs::CameraInfo info = cameraInfo(kBaseline);
  info.K.fill(0);
  info.R.fill(0);
  info.D.clear();
  info.distortion_model.clear();
  mvo::ErrorVector errors = mvo::ErrorVector::Zero();
  errors[mvo::kTurn] = 2e-3;
  EXPECT_LT(distance(correctedRight(info, learnt(errors)).right,
                     correctedRight(cameraInfo(kBaseline), learnt(errors)).right),
            1e-6);
  info.distortion_model = "wavy";
  EXPECT_NE(errorOf([&] { correctedRight(info, learnt(errors)); }).find("'wavy' is unknown"),
            std::string::npos);
}

}  // namespace
}  // namespace mvo_ros
