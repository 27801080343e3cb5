// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Tiny bags whose answer is known: a camera sliding sideways past two textured planes, drawn by
// whole-pixel shifts, so that the images are exact.
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace mvo::test {

constexpr int kWidth = 320;
constexpr int kHeight = 240;
constexpr double kFocalLength = 250;  // [px]
constexpr double kBaseline = 0.12;    // [m]
constexpr double kStep = 0.015;       // [m] along +x per frame
constexpr double kFirstStamp = 100;   // [s]
constexpr double kPeriod = 0.1;       // [s]
constexpr int kNearDisparity = 16;    // lower half [px]; moves 2 px per frame
constexpr int kFarDisparity = 8;      // upper half [px]; moves 1 px per frame

/// Blurred noise of full contrast.
inline cv::Mat texture(int width, int height) {
  cv::Mat image(height, width, CV_8U);
  cv::RNG rng(7);
  rng.fill(image, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(image, image, {}, 1.5);
  cv::normalize(image, image, 0, 255, cv::NORM_MINMAX);
  return image;
}

/// What the camera sees in frame k < 200, from its left (0) or right (1) eye.
inline cv::Mat slidingView(int k, int eye) {
  static const cv::Mat wall = texture(kWidth + 2 * kNearDisparity + 400, kHeight);
  cv::Mat image(kHeight, kWidth, CV_8U);
  const auto half = [&](int top, int disparity) {
    const int shift = disparity * eye + k * disparity / 8;
    wall(cv::Rect(shift, top, kWidth, kHeight / 2))
        .copyTo(image(cv::Rect(0, top, kWidth, kHeight / 2)));
  };
  half(0, kFarDisparity);
  half(kHeight / 2, kNearDisparity);
  return image;
}

/// Its depth [m].
inline cv::Mat slidingDepth() {
  cv::Mat depth(kHeight, kWidth, CV_32F, cv::Scalar(kFocalLength * kBaseline / kFarDisparity));
  depth.rowRange(kHeight / 2, kHeight).setTo(kFocalLength * kBaseline / kNearDisparity);
  return depth;
}

inline sensor_msgs::CameraInfo cameraInfo(double baseline, int width = kWidth,
                                          int height = kHeight) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<unsigned>(width);
  info.height = static_cast<unsigned>(height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  const double cx = (width - 1) / 2.0;
  const double cy = (height - 1) / 2.0;
  info.K = {kFocalLength, 0, cx, 0, kFocalLength, cy, 0, 0, 1};
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {kFocalLength, 0, cx, -kFocalLength * baseline, 0, kFocalLength, cy, 0, 0, 0, 1, 0};
  return info;
}

inline sensor_msgs::Image imageMessage(const cv::Mat& pixels, const std::string& encoding) {
  return *cv_bridge::CvImage({}, encoding, pixels).toImageMsg();
}

inline sensor_msgs::CompressedImage compressedMessage(const cv::Mat& pixels,
                                                      const std::string& extension,
                                                      const std::string& format) {
  sensor_msgs::CompressedImage message;
  message.format = format;
  cv::imencode(extension, pixels, message.data);
  return message;
}

/// A bag being written; a message is recorded at its stamp unless told otherwise.
class TestBag {
 public:
  explicit TestBag(const std::filesystem::path& path)
      : path_(path.string()), bag_(path_, rosbag::bagmode::Write) {}

  template <class Message>
  void write(const std::string& topic, double stamp, Message message) {
    write(topic, stamp, message, stamp);
  }
  template <class Message>
  void write(const std::string& topic, double stamp, Message message, double recorded) {
    message.header.stamp = ros::Time(stamp);
    bag_.write(topic, ros::Time(recorded), message);
  }
  void close() { bag_.close(); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  rosbag::Bag bag_;
};

inline double stampOf(int k) { return kFirstStamp + k * kPeriod; }

inline void writeInfos(TestBag& bag, double baseline = kBaseline) {
  bag.write("/stereo/left/camera_info", kFirstStamp, cameraInfo(0));
  bag.write("/stereo/right/camera_info", kFirstStamp, cameraInfo(baseline));
}

inline void writePair(TestBag& bag, double stamp, const cv::Mat& left, const cv::Mat& right) {
  bag.write("/stereo/left/image_rect", stamp, imageMessage(left, "mono8"));
  bag.write("/stereo/right/image_rect", stamp, imageMessage(right, "mono8"));
}

/// The camera sliding sideways for some frames.
inline std::string writeSlidingBag(const std::filesystem::path& path, int frames) {
  TestBag bag(path);
  writeInfos(bag);
  for (int k = 0; k < frames; ++k) writePair(bag, stampOf(k), slidingView(k, 0), slidingView(k, 1));
  bag.close();
  return path.string();
}

}  // namespace mvo::test
