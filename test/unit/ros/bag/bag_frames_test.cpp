// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/bag_frames.hpp"

#include <gtest/gtest.h>
#include <std_msgs/String.h>

#include <cmath>
#include <fstream>

#include "support/temporary_folder.hpp"
#include "support/test_bag.hpp"

namespace mvo_ros {
namespace {

using mvo::test::cameraInfo;
using mvo::test::errorOf;
using mvo::test::imageMessage;
using mvo::test::kBaseline;
using mvo::test::slidingDepth;
using mvo::test::slidingView;
using mvo::test::stampOf;
using mvo::test::TemporaryFolder;
using mvo::test::TestBag;
using mvo::test::writeInfos;
using mvo::test::writePair;
using mvo::test::writeSlidingBag;

constexpr char kLeft[] = "/stereo/left/image_rect";
constexpr char kRight[] = "/stereo/right/image_rect";

bool equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

std::vector<double> secondsOf(BagFrames& bag) {
  std::vector<double> stamps;
  while (const auto next = bag.next()) stamps.push_back(1e-9 * next->frame.stamp_ns);
  return stamps;
}

std::string errorReading(const std::string& path, const BagRequest& request = {}) {
  return errorOf([&] {
    BagFrames bag(path, request);
    while (bag.next()) {
    }
  });
}

void expectSays(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "says: " << text << "\nnot: " << part;
}

class BagFramesTest : public ::testing::Test {
 protected:
  // A bag of stereo images (which need no content) with these stamps.
  std::string bagWith(const std::vector<double>& left, const std::vector<double>& right) {
    TestBag bag(folder_ / "stamps.bag");
    writeInfos(bag);
    for (const double stamp : left) bag.write(kLeft, stamp, imageMessage(blank_, "mono8"));
    for (const double stamp : right) bag.write(kRight, stamp, imageMessage(blank_, "mono8"));
    bag.close();
    return bag.path();
  }

  TemporaryFolder folder_;
  const cv::Mat blank_ = cv::Mat(mvo::test::kHeight, mvo::test::kWidth, CV_8U, cv::Scalar(50));
};

TEST_F(BagFramesTest, ReadsEveryPairInOrder) {
  BagFrames bag(writeSlidingBag(folder_ / "slide.bag", 4), {});
  EXPECT_DOUBLE_EQ(bag.camera().baseline, kBaseline);
  EXPECT_EQ(bag.size(), 4U);
  EXPECT_NEAR(bag.rate(), 10, 0.01);
  for (int k = 0; k < 4; ++k) {
    const auto next = bag.next();
    ASSERT_TRUE(next);
    EXPECT_EQ(next->frame.stamp_ns, 100'000'000'000 + k * 100'000'000LL);
    EXPECT_TRUE(equal(next->frame.left, slidingView(k, 0)));
    EXPECT_TRUE(equal(next->frame.right, slidingView(k, 1)));
    EXPECT_TRUE(next->frame.depth.empty());
    EXPECT_EQ(bag.position(), static_cast<std::size_t>(k) + 1);
  }
  EXPECT_FALSE(bag.next());
  EXPECT_FALSE(bag.next());
  EXPECT_EQ(bag.unpaired(), 0U);
}

TEST_F(BagFramesTest, ImagesWithoutAPartnerAreCounted) {
  BagFrames bag(bagWith({1, 2, 3, 5, 6}, {1, 3, 4, 5}), {});
  EXPECT_EQ(secondsOf(bag), (std::vector<double>{1, 3, 5}));
  EXPECT_EQ(bag.unpaired(), 3U);  // left 2 and 6, right 4
}

TEST_F(BagFramesTest, ToleranceTakesTheNearestPartner) {
  BagRequest request;
  request.sync_tolerance = 0.5;
  // 2.25 is nearer to 2.3 than 1.9 is; 3.0 and 3.45 are near enough; 5 is alone.
  BagFrames bag(bagWith({1.0, 1.9, 2.25, 3.0, 5.0}, {1.1, 2.3, 3.45}), request);
  EXPECT_EQ(secondsOf(bag), (std::vector<double>{1.0, 2.25, 3.0}));
  EXPECT_EQ(bag.unpaired(), 2U);

  request.sync_tolerance = 0.1;
  BagFrames strict(bagWith({1.0, 1.9, 2.25, 3.0, 5.0}, {1.1, 2.3, 3.45}), request);
  EXPECT_EQ(secondsOf(strict), (std::vector<double>{1.0, 2.25}));
}

TEST_F(BagFramesTest, ReadsOnlyTheStretchAskedFor) {
  BagRequest request;
  request.start = 2;
  request.duration = 3;
  BagFrames bag(bagWith({10, 11, 12, 13, 14, 15}, {10, 11, 12, 13, 14, 15}), request);
  EXPECT_EQ(bag.size(), 3U);
  EXPECT_EQ(secondsOf(bag), (std::vector<double>{12, 13, 14}));
  EXPECT_EQ(bag.position(), 3U);
  EXPECT_EQ(bag.unpaired(), 0U);

  request.start = 60;
  BagFrames beyond(bagWith({10, 11}, {10, 11}), request);
  EXPECT_TRUE(secondsOf(beyond).empty());
}

TEST_F(BagFramesTest, FindsCompressedTopicsByItself) {
  TestBag bag(folder_ / "compressed.bag");
  writeInfos(bag);
  for (const auto& [topic, eye] : {std::pair(kLeft, 0), std::pair(kRight, 1)})
    bag.write(std::string(topic) + "/compressed", stampOf(0),
              mvo::test::compressedMessage(slidingView(0, eye), ".png", "mono8; png compressed"));
  bag.close();
  BagFrames frames(bag.path(), {});
  const auto next = frames.next();
  ASSERT_TRUE(next);
  EXPECT_TRUE(equal(next->frame.right, slidingView(0, 1)));
}

// A decoder would fill what is missing with grey rows.
TEST_F(BagFramesTest, RefusesJpegsThatEndEarlyNamingTheirTopic) {
  TestBag bag(folder_ / "cut.bag");
  writeInfos(bag);
  for (const auto& [topic, eye] :
       {std::pair("/stereo/left/image_rect", 0), std::pair("/stereo/right/image_rect", 1)}) {
    auto message = mvo::test::compressedMessage(slidingView(0, eye), ".jpg", "mono8; jpeg");
    if (eye == 1) message.data.resize(message.data.size() * 55 / 100);
    bag.write(std::string(topic) + "/compressed", stampOf(0), message);
  }
  bag.close();
  BagFrames frames(bag.path(), BagRequest());
  const std::string error = errorOf([&] { frames.next(); });
  EXPECT_NE(error.find("topic /stereo/right/image_rect/compressed, stamp "), std::string::npos)
      << error;
  EXPECT_NE(error.find("is cut short"), std::string::npos) << error;
}

TEST_F(BagFramesTest, RectifiesRawImages) {
  sensor_msgs::CameraInfo left = cameraInfo(0);
  sensor_msgs::CameraInfo right = cameraInfo(kBaseline);
  right.K[2] -= 7;  // the raw right image is 7 px to the left of the rectified one
  right.P[2] += 3;  // and its projection is not quite the left one's, which counts
  right.P[3] = -right.P[0] * kBaseline;
  TestBag bag(folder_ / "raw.bag");
  bag.write("/stereo/left/camera_info", 1, left);
  bag.write("/stereo/right/camera_info", 1, right);
  bag.write("/stereo/left/image_raw", 1, imageMessage(slidingView(0, 0), "mono8"));
  bag.write("/stereo/right/image_raw", 1, imageMessage(slidingView(0, 1), "mono8"));
  bag.close();
  BagRequest request;
  request.setup.raw = true;
  request.setup.topics = usualTopics(Sensor::kStereo, true);
  BagFrames frames(bag.path(), request);
  const auto next = frames.next();
  ASSERT_TRUE(next);
  EXPECT_DOUBLE_EQ(frames.camera().baseline, kBaseline);
  EXPECT_TRUE(equal(next->frame.left, slidingView(0, 0)));
  const cv::Rect inside(10, 0, 300, 240);
  EXPECT_TRUE(equal(next->frame.right(inside),
                    slidingView(0, 1)(cv::Rect(inside.x - 7, 0, inside.width, inside.height))));
}

TEST_F(BagFramesTest, ReadsColourAndDepth) {
  cv::Mat color;
  cv::cvtColor(slidingView(0, 0), color, cv::COLOR_GRAY2BGR);
  cv::Mat depth = slidingDepth();
  depth.at<float>(3, 4) = std::numeric_limits<float>::quiet_NaN();
  TestBag bag(folder_ / "rgbd.bag");
  bag.write("/camera/rgb/camera_info", 1, cameraInfo(0));
  bag.write("/camera/rgb/image_rect_color", 1, imageMessage(color, "bgr8"));
  bag.write("/camera/depth_registered/image_rect", 1, imageMessage(depth, "32FC1"));
  bag.close();
  BagRequest request;
  request.setup.sensor = Sensor::kRgbd;
  request.setup.topics = usualTopics(Sensor::kRgbd, false);
  request.setup.virtual_baseline = 0.07;
  BagFrames frames(bag.path(), request);
  EXPECT_DOUBLE_EQ(frames.camera().baseline, 0.07);
  const auto next = frames.next();
  ASSERT_TRUE(next);
  EXPECT_TRUE(equal(next->frame.left, slidingView(0, 0)));
  EXPECT_TRUE(next->frame.right.empty());
  EXPECT_TRUE(std::isnan(next->frame.depth.at<float>(3, 4)));
  EXPECT_FLOAT_EQ(next->frame.depth.at<float>(0, 0), 3.75F);
}

TEST_F(BagFramesTest, NamesTheTopicThatIsMissingAndThoseThereAre) {
  TestBag bag(folder_ / "other.bag");
  bag.write("/front/image", 1, imageMessage(blank_, "mono8"));
  bag.close();
  const std::string error = errorReading(bag.path());
  expectSays(error, std::string("topic ") + kLeft + " is not in ");
  expectSays(error, "which has /front/image (sensor_msgs/Image)");
}

TEST_F(BagFramesTest, NeedsCalibration) {
  TestBag bag(folder_ / "no_info.bag");
  writePair(bag, 1, blank_, blank_);
  bag.close();
  expectSays(errorReading(bag.path()), "topic /stereo/left/camera_info is not in ");

  TestBag zero(folder_ / "zero_info.bag");
  zero.write("/stereo/left/camera_info", 1, sensor_msgs::CameraInfo());
  zero.write("/stereo/right/camera_info", 1, sensor_msgs::CameraInfo());
  writePair(zero, 1, blank_, blank_);
  zero.close();
  expectSays(errorReading(zero.path()),
             "topic /stereo/left/camera_info: the calibration is all zero");

  TestBag flat(folder_ / "no_baseline.bag");
  writeInfos(flat, 0);
  writePair(flat, 1, blank_, blank_);
  flat.close();
  expectSays(errorReading(flat.path()),
             "topic /stereo/right/camera_info: the calibration has no baseline");
}

TEST_F(BagFramesTest, RefusesTopicsOfAnotherType) {
  TestBag bag(folder_ / "typed.bag");
  writeInfos(bag);
  bag.write(kLeft, 1, cameraInfo(0));
  bag.write(kRight, 1, imageMessage(blank_, "mono8"));
  bag.close();
  expectSays(errorReading(bag.path()), std::string("topic ") + kLeft +
                                           " holds sensor_msgs/CameraInfo, not sensor_msgs/Image");
}

TEST_F(BagFramesTest, RefusesImagesOfAnotherSize) {
  TestBag bag(folder_ / "sizes.bag");
  writeInfos(bag);
  writePair(bag, 1, blank_, blank_(cv::Rect(0, 0, 160, 120)));
  bag.close();
  const std::string error = errorReading(bag.path());
  expectSays(error, std::string("topic ") + kRight + ", stamp 1.000000000: the image has 160x120");
  expectSays(error, "is for 320x240");

  TestBag midway(folder_ / "midway.bag");
  writeInfos(midway);
  writePair(midway, 1, blank_, blank_);
  writePair(midway, 2, blank_(cv::Rect(0, 0, 160, 120)), blank_(cv::Rect(0, 0, 160, 120)));
  midway.close();
  expectSays(errorReading(midway.path()), std::string("topic ") + kLeft + ", stamp 2.000000000");
}

TEST_F(BagFramesTest, RefusesStampsThatGoBackOrStandStill) {
  TestBag bag(folder_ / "back.bag");
  writeInfos(bag);
  for (const double stamp : {5.0, 4.0})
    for (const char* topic : {kLeft, kRight})
      bag.write(topic, stamp, imageMessage(blank_, "mono8"), 10 - stamp);  // recorded 5 first
  bag.close();
  expectSays(errorReading(bag.path()),
             "the stamps do not increase, 4.000000000 follows 5.000000000");
  expectSays(errorReading(bagWith({1, 1}, {1, 2})),
             "the stamps do not increase, 1.000000000 follows 1.000000000");
}

TEST_F(BagFramesTest, RefusesUnknownEncodings) {
  sensor_msgs::Image odd = imageMessage(blank_, "mono8");
  odd.encoding = "infrared7";
  TestBag bag(folder_ / "odd.bag");
  writeInfos(bag);
  bag.write(kLeft, 1, odd);
  bag.write(kRight, 1, odd);
  bag.close();
  const std::string error = errorReading(bag.path());
  expectSays(error, std::string("topic ") + kLeft);
  expectSays(error, "encoding 'infrared7'");
}

TEST_F(BagFramesTest, RefusesFilesThatAreNoWholeBag) {
  expectSays(errorReading((folder_ / "none.bag").string()), "none.bag does not exist");
  expectSays(errorReading(folder_.path().string()), "is not a file");

  std::ofstream(folder_ / "zero.bag").flush();
  expectSays(errorReading((folder_ / "zero.bag").string()), "zero.bag is empty");

  std::ofstream(folder_ / "text.bag") << "this is a letter, not a bag of images\n";
  expectSays(errorReading((folder_ / "text.bag").string()), "text.bag is not a bag");

  TestBag empty(folder_ / "empty.bag");
  empty.close();
  expectSays(errorReading(empty.path()), "empty.bag holds no messages");

  const std::string whole = writeSlidingBag(folder_ / "whole.bag", 3);
  for (const double share : {0.9, 0.5, 0.1}) {
    const auto cut = folder_ / "cut.bag";
    std::filesystem::copy_file(whole, cut, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(
        cut, static_cast<std::uintmax_t>(share *
                                         static_cast<double>(std::filesystem::file_size(whole))));
    const std::string error = errorReading(cut.string());
    expectSays(error, "cut.bag ");
    expectSays(error, "cut off");
  }
}

// An index that is whole does not make the data so.
TEST_F(BagFramesTest, RefusesDamagedData) {
  const std::string path = writeSlidingBag(folder_ / "damaged.bag", 3);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(200'000);
    file << std::string(200'000, '\xff');
  }
  EXPECT_NE(errorReading(path), "no error");
}

}  // namespace
}  // namespace mvo_ros
