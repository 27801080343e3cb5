// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>

#include "mvo/sequence.hpp"
#include "mvo/trajectory_files.hpp"

namespace mvo {
namespace {

class SequenceWriterTest : public testing::Test {
 protected:
  SequenceWriterTest() { std::filesystem::remove_all(folder_); }
  ~SequenceWriterTest() override { std::filesystem::remove_all(folder_); }

  nlohmann::json calibration() const {
    std::ifstream file(folder_ / "calib.json");
    return nlohmann::json::parse(file);
  }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) / "mvo_sequence_writer_test";
};

SequenceInfo info(bool rgbd) { return {rgbd, {50, 51, 7.5, 5.5, 0.2, 16, 12}, 10}; }

SequenceFrame frameAt(int i) {
  SequenceFrame frame;
  frame.stamp_ns = 1'500'000'000'000'000'000 + i * 100'000'000LL;
  frame.left = cv::Mat(12, 16, CV_8UC1, cv::Scalar(10 + i));
  frame.right = cv::Mat(12, 16, CV_8UC1, cv::Scalar(20 + i));
  frame.mask = cv::Mat(12, 16, CV_8UC1, cv::Scalar(1));
  frame.T_world_camera = Eigen::Isometry3d::Identity();
  frame.T_world_camera->translation() = Eigen::Vector3d(i, 2, 3);
  frame.T_world_bodies[1] = *frame.T_world_camera;
  frame.objects = {{1, 96, 0.5, 120, 0.9, 0.8}};
  return frame;
}

TEST_F(SequenceWriterTest, TruthIsReadBack) {
  SequenceWriter writer(folder_, info(false));
  writer.add(frameAt(0));
  writer.add(frameAt(1));
  writer.finish();
  const Truth truth = readTruth(folder_);
  ASSERT_EQ(truth.stamps_ns.size(), 2U);
  EXPECT_EQ(truth.stamps_ns[1], 1'500'000'000'100'000'000);
  ASSERT_EQ(truth.camera.size(), 2U);
  EXPECT_EQ(truth.camera[1].T_world_body.translation(), Eigen::Vector3d(1, 2, 3));
  ASSERT_EQ(truth.bodies.at(1).size(), 2U);
  ASSERT_EQ(truth.visibility.size(), 2U);
  EXPECT_EQ(truth.visibility[0].body, 1);
  EXPECT_DOUBLE_EQ(truth.visibility[0].image_share, 0.5);
  EXPECT_DOUBLE_EQ(truth.visibility[0].visible_share, 0.8);
  EXPECT_EQ(cv::countNonZero(truth.mask(1) == 1), 12 * 16);
  const cv::Mat right =
      cv::imread((folder_ / "right" / "000001.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(right.type(), CV_8UC1);
  EXPECT_EQ(right.at<std::uint8_t>(3, 4), 21);
}

TEST_F(SequenceWriterTest, CalibrationHasTheCamera) {
  SequenceWriter(folder_, info(false)).finish();
  const auto json = calibration();
  EXPECT_EQ(json["type"], "stereo");
  EXPECT_EQ(json["width"], 16);
  EXPECT_EQ(json["fy"], 51.0);
  EXPECT_EQ(json["cx"], 7.5);
  EXPECT_EQ(json["baseline"], 0.2);
  EXPECT_EQ(json["fps"], 10.0);
}

TEST_F(SequenceWriterTest, RgbdKeepsSixteenBitsOfDepth) {
  SequenceFrame frame = frameAt(0);
  frame.left = cv::Mat(12, 16, CV_8UC3, cv::Scalar(1, 2, 3));
  frame.right = cv::Mat(12, 16, CV_16UC1, cv::Scalar(4321));
  SequenceWriter writer(folder_, info(true));
  writer.add(frame);
  writer.finish();
  const cv::Mat depth =
      cv::imread((folder_ / "depth" / "000000.png").string(), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(depth.type(), CV_16UC1);
  EXPECT_EQ(depth.at<std::uint16_t>(0, 0), 4321);
  const cv::Mat color = cv::imread((folder_ / "rgb" / "000000.png").string());
  EXPECT_EQ(color.at<cv::Vec3b>(0, 0), cv::Vec3b(1, 2, 3));
  const auto json = calibration();
  EXPECT_EQ(json["type"], "rgbd");
  EXPECT_EQ(json["depth_unit_m"], 0.001);
}

TEST_F(SequenceWriterTest, ImagesAloneAreNotASequenceYet) {
  SequenceWriter writer(folder_, info(false));
  writer.add(frameAt(0));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "calib.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "times.txt"));
}

}  // namespace
}  // namespace mvo
