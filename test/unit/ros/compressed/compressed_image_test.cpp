// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/compressed/compressed_image.hpp"

#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace {

using mvo_ros::compressImage;
using mvo_ros::decompressImage;

constexpr int kQuality = 95;

// Smooth, as photographs are: what JPEG keeps.
cv::Mat picture(int type) {
  cv::Mat pixels(48, 64, type);
  for (int v = 0; v < pixels.rows; ++v)
    for (int u = 0; u < pixels.cols; ++u)
      for (int c = 0; c < pixels.channels(); ++c) {
        const int value = c == 3 ? 255 : (2 * u + 2 * v + 60 * c) % 250;
        if (pixels.depth() == CV_16U)
          pixels.ptr<std::uint16_t>(v)[u * pixels.channels() + c] =
              static_cast<std::uint16_t>(value * 257 + u);
        else
          pixels.ptr<std::uint8_t>(v)[u * pixels.channels() + c] = static_cast<std::uint8_t>(value);
      }
  return pixels;
}

sensor_msgs::Image message(const std::string& encoding) {
  std_msgs::Header header;
  header.stamp = ros::Time(12, 34);
  header.frame_id = "eye";
  cv::Mat pixels = picture(cv_bridge::getCvType(encoding));
  // JPEG blurs colour at the edge where the ramp wraps.
  if (pixels.depth() == CV_8U) cv::blur(pixels, pixels, {9, 9});
  return *cv_bridge::CvImage(header, encoding, pixels).toImageMsg();
}

double meanDifference(const sensor_msgs::Image& a, const sensor_msgs::Image& b) {
  const auto one = cv_bridge::toCvCopy(a);
  const auto two = cv_bridge::toCvCopy(b);
  return cv::norm(one->image, two->image, cv::NORM_L1) /
         static_cast<double>(one->image.total() * one->image.channels());
}

struct Case {
  const char* encoding;
  const char* format;
  double tolerance;  // mean difference [grey levels]
};

class EveryEncoding : public testing::TestWithParam<Case> {};

TEST_P(EveryEncoding, ComesBackAsItWas) {
  const auto& [encoding, format, tolerance] = GetParam();
  const sensor_msgs::Image image = message(encoding);
  const sensor_msgs::CompressedImage packed = compressImage(image, kQuality);
  EXPECT_EQ(packed.format, format);
  EXPECT_EQ(packed.header.stamp, image.header.stamp);
  EXPECT_EQ(packed.header.frame_id, "eye");
  const auto unpacked = decompressImage(packed);
  EXPECT_EQ(unpacked->header.stamp, image.header.stamp);
  EXPECT_EQ(unpacked->header.frame_id, "eye");
  ASSERT_EQ(unpacked->encoding, encoding);
  ASSERT_EQ(unpacked->width, image.width);
  ASSERT_EQ(unpacked->height, image.height);
  EXPECT_LE(meanDifference(image, *unpacked), tolerance);
}

INSTANTIATE_TEST_SUITE_P(Compressed, EveryEncoding,
                         testing::Values(Case{"mono8", "mono8; jpeg compressed ", 1},
                                         Case{"8UC1", "8UC1; jpeg compressed ", 1},
                                         Case{"bgr8", "bgr8; jpeg compressed bgr8", 2.5},
                                         Case{"rgb8", "rgb8; jpeg compressed bgr8", 2.5},
                                         Case{"bgra8", "bgra8; jpeg compressed bgr8", 2.5},
                                         Case{"rgba8", "rgba8; jpeg compressed bgr8", 2.5},
                                         Case{"bayer_rggb8", "bayer_rggb8; jpeg compressed ", 1},
                                         Case{"mono16", "mono16; png compressed ", 0},
                                         Case{"rgb16", "rgb16; png compressed bgr16", 0},
                                         Case{"16UC1", "16UC1; png compressed ", 0}));

TEST(Compressed, DepthKeepsHoles) {
  cv::Mat depth(20, 30, CV_16UC1, cv::Scalar(0));
  depth.at<std::uint16_t>(3, 4) = 65535;
  depth.at<std::uint16_t>(5, 6) = 1;
  const auto image = *cv_bridge::CvImage({}, "16UC1", depth).toImageMsg();
  EXPECT_EQ(decompressImage(compressImage(image, kQuality))->data, image.data);
}

TEST(Compressed, QualityCosts) {
  const auto image = message("mono8");
  EXPECT_LT(compressImage(image, 20).data.size(), compressImage(image, 95).data.size());
}

TEST(Compressed, FloatingDepthIsRefused) {
  try {
    compressImage(message("32FC1"), kQuality);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("'32FC1'"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("16UC1"), std::string::npos) << error.what();
  }
}

TEST(Compressed, DataThatDoNotFillTheImageAreRefused) {
  auto image = message("mono8");
  image.data.resize(10);
  EXPECT_THROW(compressImage(image, kQuality), std::runtime_error);
}

// A decoder would fill what is missing with grey.
TEST(Compressed, CutAndBrokenDataAreRefused) {
  for (const char* encoding : {"mono8", "bgr8", "16UC1"}) {
    const auto whole = compressImage(message(encoding), kQuality);
    auto cut = whole;
    for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{20},
                                   whole.data.size() / 2, whole.data.size() - 20}) {
      cut.data.assign(whole.data.begin(), whole.data.begin() + static_cast<long>(size));
      EXPECT_THROW(decompressImage(cut), std::runtime_error) << encoding << ", " << size;
    }
    auto noise = whole;
    std::fill(noise.data.begin(), noise.data.end(), 0x55);
    EXPECT_THROW(decompressImage(noise), std::runtime_error) << encoding;
  }
}

TEST(Compressed, CamerasMayPadJpegs) {
  auto packed = compressImage(message("mono8"), kQuality);
  packed.data.resize(packed.data.size() + 500, 0);
  EXPECT_EQ(decompressImage(packed)->width, 64U);
}

// What other writers say, or do not say, about their pixels.
TEST(Compressed, FormatsOfOthers) {
  const auto gray = compressImage(message("mono8"), kQuality);
  const auto color = compressImage(message("bgr8"), kQuality);
  auto other = gray;
  other.format = "jpeg";
  EXPECT_EQ(decompressImage(other)->encoding, "mono8");
  other.format = "mono8; jpeg compressed mono8";
  EXPECT_EQ(decompressImage(other)->encoding, "mono8");
  other.format = "bgr8; jpeg compressed bgr8";  // grey data all the same
  EXPECT_EQ(decompressImage(other)->encoding, "mono8");
  other = color;
  other.format = "jpeg";
  EXPECT_EQ(decompressImage(other)->encoding, "bgr8");
  other.format = "nonsense; jpeg compressed bgr8";
  EXPECT_EQ(decompressImage(other)->encoding, "bgr8");
  other = compressImage(message("16UC1"), kQuality);
  other.format = "png";
  EXPECT_EQ(decompressImage(other)->encoding, "16UC1");
}

}  // namespace
