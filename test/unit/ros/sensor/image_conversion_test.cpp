// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/image_conversion.hpp"

#include <gtest/gtest.h>
#include <sensor_msgs/image_encodings.h>

#include <cmath>
#include <limits>

#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"

namespace mvo_ros {
namespace {

using mvo::test::compressedMessage;
using mvo::test::errorOf;
using mvo::test::imageMessage;
using ::testing::Test;

// ITU-R BT.601, as OpenCV and cv_bridge use it.
constexpr int kGreyOfRed = 76;
constexpr int kGreyOfGreen = 150;
constexpr int kGreyOfBlue = 29;

void expectGrey(const cv::Mat& image, const std::vector<int>& values, int tolerance = 0) {
  ASSERT_EQ(image.type(), CV_8UC1);
  ASSERT_EQ(image.total(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_NEAR(image.at<unsigned char>(static_cast<int>(i)), values[i], tolerance) << i;
}

TEST(ImageConversion, Mono8KeepsItsValuesAndSkipsPadding) {
  sensor_msgs::Image message = imageMessage((cv::Mat_<unsigned char>(1, 3) << 10, 0, 255), "mono8");
  expectGrey(greyImage(message), {10, 0, 255});
  message.width = 2;  // the third byte is padding now
  expectGrey(greyImage(message), {10, 0});
}

TEST(ImageConversion, Mono16IsScaledByItsFullRange) {
  const cv::Mat deep = (cv::Mat_<std::uint16_t>(1, 3) << 0, 100 * 257, 65535);
  expectGrey(greyImage(imageMessage(deep, "mono16")), {0, 100, 255}, 1);
  expectGrey(greyImage(imageMessage(deep, "16UC1")), {0, 100, 255}, 1);
}

TEST(ImageConversion, BigEndianPixelsAreSwapped) {
  sensor_msgs::Image message =
      imageMessage((cv::Mat_<std::uint16_t>(1, 2) << 0x00ff, 0x8000), "mono16");
  message.is_bigendian = 1;  // so they are 0xff00 and 0x0080
  expectGrey(greyImage(message), {254, 0}, 1);
}

TEST(ImageConversion, ColoursHaveTheirBrightnessInEitherOrder) {
  const cv::Mat bgr = (cv::Mat_<cv::Vec3b>(1, 3) << cv::Vec3b(255, 0, 0), cv::Vec3b(0, 255, 0),
                       cv::Vec3b(0, 0, 255));
  const std::vector<int> blue_green_red = {kGreyOfBlue, kGreyOfGreen, kGreyOfRed};
  const std::vector<int> red_green_blue = {kGreyOfRed, kGreyOfGreen, kGreyOfBlue};
  expectGrey(greyImage(imageMessage(bgr, "bgr8")), blue_green_red, 1);
  expectGrey(greyImage(imageMessage(bgr, "8UC3")), blue_green_red, 1);
  expectGrey(greyImage(imageMessage(bgr, "rgb8")), red_green_blue, 1);
  cv::Mat bgra;
  cv::cvtColor(bgr, bgra, cv::COLOR_BGR2BGRA);
  expectGrey(greyImage(imageMessage(bgra, "bgra8")), blue_green_red, 1);
  expectGrey(greyImage(imageMessage(bgra, "rgba8")), red_green_blue, 1);
}

// Only the pixels of the pattern's first corner are lit: they are red in RGGB, blue in BGGR and
// green in the other two.
TEST(ImageConversion, EachBayerPatternIsReadAsItself) {
  cv::Mat mosaic = cv::Mat::zeros(16, 16, CV_8U);
  for (int y = 0; y < mosaic.rows; y += 2)
    for (int x = 0; x < mosaic.cols; x += 2) mosaic.at<unsigned char>(y, x) = 255;
  const auto center = [](const cv::Mat& grey) { return cv::mean(grey(cv::Rect(4, 4, 8, 8)))[0]; };
  EXPECT_NEAR(center(greyImage(imageMessage(mosaic, "bayer_rggb8"))), kGreyOfRed, 2);
  EXPECT_NEAR(center(greyImage(imageMessage(mosaic, "bayer_bggr8"))), kGreyOfBlue, 2);
  EXPECT_NEAR(center(greyImage(imageMessage(mosaic, "bayer_grbg8"))), kGreyOfGreen / 2.0, 2);
  EXPECT_NEAR(center(greyImage(imageMessage(mosaic, "bayer_gbrg8"))), kGreyOfGreen / 2.0, 2);
  EXPECT_NEAR(center(greyImage(compressedMessage(mosaic, ".png", "bayer_rggb8; png compressed "))),
              kGreyOfRed, 2);
}

TEST(ImageConversion, TheImageOutlivesItsMessage) {
  cv::Mat grey;
  {
    const sensor_msgs::Image message = imageMessage(cv::Mat(4, 4, CV_8U, cv::Scalar(77)), "mono8");
    grey = greyImage(message);
    EXPECT_NE(static_cast<const void*>(grey.data), static_cast<const void*>(message.data.data()));
  }
  EXPECT_EQ(cv::countNonZero(grey == 77), 16);
}

TEST(ImageConversion, CompressedImagesAreDecoded) {
  const cv::Mat grey(8, 8, CV_8U, cv::Scalar(90));
  EXPECT_NEAR(cv::mean(greyImage(compressedMessage(grey, ".jpg", "jpeg")))[0], 90, 1);
  EXPECT_NEAR(cv::mean(greyImage(compressedMessage(grey, ".png", "mono8; png compressed")))[0], 90,
              0);
  const cv::Mat red(8, 8, CV_8UC3, cv::Scalar(0, 0, 255));
  EXPECT_NEAR(cv::mean(greyImage(compressedMessage(red, ".png", "rgb8; png compressed bgr8")))[0],
              kGreyOfRed, 1);
}

TEST(ImageConversion, DepthIsInMetresAndHolesAreNan) {
  const cv::Mat millimetres = (cv::Mat_<std::uint16_t>(1, 3) << 0, 1500, 65535);
  const cv::Mat packed = depthImage(compressedMessage(millimetres, ".png", "16UC1; png"));
  for (const cv::Mat& depth : {depthImage(imageMessage(millimetres, "16UC1")), packed}) {
    ASSERT_EQ(depth.type(), CV_32FC1);
    EXPECT_TRUE(std::isnan(depth.at<float>(0)));
    EXPECT_FLOAT_EQ(depth.at<float>(1), 1.5F);
    EXPECT_FLOAT_EQ(depth.at<float>(2), 65.535F);
  }
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const cv::Mat depth = depthImage(
      imageMessage((cv::Mat_<float>(1, 5) << 2.5F, 0.0F, -1.0F, infinite, nan), "32FC1"));
  EXPECT_FLOAT_EQ(depth.at<float>(0), 2.5F);
  for (int i = 1; i < 5; ++i) EXPECT_TRUE(std::isnan(depth.at<float>(i))) << i;
}

TEST(ImageConversion, RefusesWhatIsNoImageNamingTheEncoding) {
  const cv::Mat pixels(4, 4, CV_8U, cv::Scalar(1));
  const auto greyError = [](const auto& m) { return errorOf([&m] { greyImage(m); }); };
  const auto depthError = [](const auto& m) { return errorOf([&m] { depthImage(m); }); };

  sensor_msgs::Image unknown = imageMessage(pixels, "mono8");
  unknown.encoding = "infrared7";
  EXPECT_NE(greyError(unknown).find("encoding 'infrared7'"), std::string::npos);
  EXPECT_NE(depthError(unknown).find("encoding 'infrared7'"), std::string::npos);
  EXPECT_NE(greyError(imageMessage(cv::Mat(2, 2, CV_32F, cv::Scalar(1)), "32FC1"))
                .find("encoding '32FC1'"),
            std::string::npos);
  EXPECT_NE(depthError(imageMessage(pixels, "mono8")).find("is no depth image"), std::string::npos);

  sensor_msgs::Image cut = imageMessage(pixels, "mono8");
  cut.data.pop_back();
  EXPECT_NE(greyError(cut).find("cannot be read"), std::string::npos);
  EXPECT_NE(greyError(sensor_msgs::Image()).find("has no pixels"), std::string::npos);

  sensor_msgs::CompressedImage junk = compressedMessage(pixels, ".png", "png");
  junk.data.assign(20, 3);
  EXPECT_NE(greyError(junk).find("format 'png', 20 bytes) cannot be decoded"), std::string::npos);
  junk.data.clear();
  EXPECT_NE(greyError(junk).find("cannot be decoded"), std::string::npos);
  EXPECT_NE(depthError(compressedMessage(pixels, ".png", "png")).find("is no depth image"),
            std::string::npos);
}

}  // namespace
}  // namespace mvo_ros
