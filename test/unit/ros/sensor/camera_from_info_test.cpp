// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/camera_from_info.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "ros/sensor/sensor_model.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"

namespace mvo_ros {
namespace {

using mvo::test::cameraInfo;
using mvo::test::errorOf;
using mvo::test::kBaseline;
using mvo::test::kFocalLength;
using Change = std::function<void(sensor_msgs::CameraInfo&)>;

mvo::StereoCamera camera(const sensor_msgs::CameraInfo& left,
                         const sensor_msgs::CameraInfo& right) {
  return stereoCamera(left, right, "/l/info", "/r/info");
}

std::string errorWith(const Change& change_left, const Change& change_right) {
  sensor_msgs::CameraInfo left = cameraInfo(0);
  sensor_msgs::CameraInfo right = cameraInfo(kBaseline);
  change_left(left);
  change_right(right);
  return errorOf([&] { camera(left, right); });
}

void nothing(sensor_msgs::CameraInfo&) {}

void expectBegins(const std::string& text, const std::string& beginning) {
  EXPECT_EQ(text.substr(0, beginning.size()), beginning);
}

TEST(CameraFromInfo, ReadsProjectionBaselineAndSize) {
  const mvo::StereoCamera c = camera(cameraInfo(0), cameraInfo(0.25));
  EXPECT_DOUBLE_EQ(c.fu, kFocalLength);
  EXPECT_DOUBLE_EQ(c.fv, kFocalLength);
  EXPECT_DOUBLE_EQ(c.cu, 159.5);
  EXPECT_DOUBLE_EQ(c.cv, 119.5);
  EXPECT_DOUBLE_EQ(c.baseline, 0.25);
  EXPECT_EQ(c.width, 320);
  EXPECT_EQ(c.height, 240);
  EXPECT_NO_THROW(c.validate());
}

TEST(CameraFromInfo, BinnedImagesHaveAnEnlargedPixel) {
  sensor_msgs::CameraInfo left = cameraInfo(0);
  sensor_msgs::CameraInfo right = cameraInfo(kBaseline);
  for (auto* info : {&left, &right}) info->binning_x = info->binning_y = 2;
  const mvo::StereoCamera c = camera(left, right);
  EXPECT_DOUBLE_EQ(c.fu, kFocalLength / 2);
  EXPECT_DOUBLE_EQ(c.baseline, kBaseline);  // the world is not binned
  EXPECT_EQ(c.width, 160);
  EXPECT_EQ(c.height, 120);
}

TEST(CameraFromInfo, RgbdHasTheVirtualBaseline) {
  const mvo::StereoCamera c = rgbdCamera(cameraInfo(0), 0.1, "/rgb/info");
  EXPECT_DOUBLE_EQ(c.baseline, 0.1);
  EXPECT_DOUBLE_EQ(c.fu, kFocalLength);
  expectBegins(errorOf([] { rgbdCamera(sensor_msgs::CameraInfo(), 0.1, "/rgb/info"); }),
               "topic /rgb/info: the calibration is all zero");
}

TEST(CameraFromInfo, RefusesCalibrationsThatAreNone) {
  const Change zero = [](auto& info) {
    info.K.fill(0);
    info.P.fill(0);
  };
  expectBegins(errorWith(zero, nothing), "topic /l/info: the calibration is all zero");
  expectBegins(errorWith(nothing, zero), "topic /r/info: the calibration is all zero");
  expectBegins(errorWith([](auto& info) { info.P.fill(0); }, nothing),
               "topic /l/info: the calibration has no projection matrix");
  expectBegins(
      errorWith([](auto& i) { i.P[2] = std::numeric_limits<double>::quiet_NaN(); }, nothing),
      "topic /l/info: the calibration's projection matrix P is not finite");
  expectBegins(errorWith(nothing, [](auto& info) { info.P[0] = -1; }),
               "topic /r/info: the focal lengths P[0] = -1");
  expectBegins(errorWith([](auto& info) { info.width = 0; }, nothing),
               "topic /l/info: the calibration does not say the image size");
}

TEST(CameraFromInfo, RefusesPairsThatAreNone) {
  expectBegins(errorWith(nothing, [](auto& info) { info.P[3] = 0; }),
               "topic /r/info: the calibration has no baseline");
  expectBegins(errorWith(nothing, [](auto& info) { info.P[3] *= -1; }),
               "topic /r/info: the baseline is -0.12");
  expectBegins(
      errorWith(nothing, [](auto& info) { info.width = 640; }),
      "topic /r/info: the calibration is for 640x240 pixels, but /l/info's is for 320x240");
  for (const int i : {0, 2, 5, 6})
    expectBegins(errorWith(nothing, [i](auto& info) { info.P[static_cast<unsigned>(i)] += 1; }),
                 "topic /r/info: the focal lengths and principal point in P differ");
}

TEST(CameraFromInfo, AlignedRightKeepsTheBaselineInMetres) {
  sensor_msgs::CameraInfo right = cameraInfo(kBaseline);
  right.P[0] = right.P[5] = 2 * kFocalLength;
  right.P[2] += 30;
  right.P[3] *= 2;
  const auto aligned = alignedRight(cameraInfo(0), right);
  EXPECT_DOUBLE_EQ(camera(cameraInfo(0), aligned).baseline, kBaseline);
  EXPECT_DOUBLE_EQ(aligned.P[2], cameraInfo(0).P[2]);
}

TEST(SensorSetup, TheVirtualBaselineIsTheOptionsOwn) {
  EXPECT_EQ(SensorSetup().virtual_baseline, mvo::Options().frontend.virtual_baseline);
}

}  // namespace
}  // namespace mvo_ros
