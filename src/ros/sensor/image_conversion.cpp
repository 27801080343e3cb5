// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/sensor/image_conversion.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <boost/make_shared.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "ros/compressed/compressed_image.hpp"

namespace mvo_ros {

namespace {

namespace encodings = sensor_msgs::image_encodings;

// cv_bridge knows how many channels these have but not that they are meant as grey or colour.
std::string meaning(const std::string& encoding) {
  if (encoding == encodings::TYPE_8UC1) return encodings::MONO8;
  if (encoding == encodings::TYPE_16UC1) return encodings::MONO16;
  if (encoding == encodings::TYPE_8UC3) return encodings::BGR8;
  if (encoding == encodings::TYPE_8UC4) return encodings::BGRA8;
  return encoding;
}

[[noreturn]] void refuse(const sensor_msgs::Image& message, const std::string& problem) {
  throw std::runtime_error("the image (" + std::to_string(message.width) + "x" +
                           std::to_string(message.height) + ", encoding '" + message.encoding +
                           "') " + problem);
}

// The message's pixels in host byte order; shares them where it can, so the message must outlive
// it.
cv_bridge::CvImageConstPtr view(const sensor_msgs::Image& message) {
  if (message.width == 0 || message.height == 0) refuse(message, "has no pixels");
  try {
    auto shared = cv_bridge::toCvShare(message, nullptr);
    const int type = cv_bridge::getCvType(message.encoding);
    if (shared->image.type() == type) return shared;
    // cv_bridge swaps bytes but forgets to make deep pixels of them again.
    const cv::Mat pixels(shared->image.size(), type, shared->image.data, shared->image.step);
    return boost::make_shared<const cv_bridge::CvImage>(message.header, message.encoding,
                                                        pixels.clone());
  } catch (const std::exception& error) {
    refuse(message, std::string("cannot be read: ") + error.what());
  }
}

cv::Mat grey(const cv_bridge::CvImage& image) {
  cv_bridge::CvImage named(image.header, meaning(image.encoding), image.image);
  if (named.encoding == encodings::MONO8) return named.image.clone();
  return cv_bridge::cvtColor(boost::make_shared<const cv_bridge::CvImage>(named), encodings::MONO8)
      ->image;
}

cv::Mat metres(const cv::Mat& depth) {
  const float hole = std::numeric_limits<float>::quiet_NaN();
  cv::Mat out;
  depth.convertTo(out, CV_32F, depth.depth() == CV_16U ? 0.001 : 1.0);
  out.forEach<float>([hole](float& z, const int*) {
    if (!(z > 0) || z > std::numeric_limits<float>::max()) z = hole;
  });
  return out;
}

bool isDepth(const std::string& encoding) {
  return encoding == encodings::TYPE_16UC1 || encoding == encodings::MONO16 ||
         encoding == encodings::TYPE_32FC1;
}

}  // namespace

cv::Mat greyImage(const sensor_msgs::Image& message) {
  const auto image = view(message);
  try {
    return grey(*image);
  } catch (const std::exception&) {
    refuse(message,
           "cannot be turned to grey: give mono8, mono16, bgr8, rgb8, bgra8, rgba8 or Bayer");
  }
}

cv::Mat greyImage(const sensor_msgs::CompressedImage& message) {
  return greyImage(*decompressImage(message));
}

cv::Mat depthImage(const sensor_msgs::Image& message) {
  if (!isDepth(message.encoding))
    refuse(message, "is no depth image: give 16UC1 (mm) or 32FC1 (m)");
  return metres(view(message)->image);
}

cv::Mat depthImage(const sensor_msgs::CompressedImage& message) {
  const auto image = decompressImage(message);
  if (!isDepth(image->encoding))
    throw std::runtime_error("the compressed image (format '" + message.format +
                             "') is no depth image: give a 16-bit PNG (mm)");
  return depthImage(*image);
}

}  // namespace mvo_ros
