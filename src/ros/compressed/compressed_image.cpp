// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/compressed/compressed_image.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <array>
#include <boost/make_shared.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace mvo_ros {

namespace {

namespace encodings = sensor_msgs::image_encodings;

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void refuse(const sensor_msgs::Image& message, const std::string& problem) {
  throw std::runtime_error("the image (" + std::to_string(message.width) + "x" +
                           std::to_string(message.height) + ", encoding '" + message.encoding +
                           "') cannot be compressed: " + problem);
}

[[noreturn]] void refuse(const sensor_msgs::CompressedImage& message, const std::string& problem) {
  throw std::runtime_error("the compressed image (format '" + message.format + "', " +
                           std::to_string(message.data.size()) + " bytes) " + problem);
}

// What the files hold: JPEG and PNG know grey and colour, OpenCV orders it blue, green, red.
std::string storedColor(int bits) { return bits == 16 ? encodings::BGR16 : encodings::BGR8; }

// A decoder fills what is missing of a cut JPEG with grey. In its data a 0xff is never followed by
// 0xd9, which ends them; cameras may pad behind.
bool isCutJpeg(const Bytes& data) {
  constexpr std::array<std::uint8_t, 2> kStart = {0xff, 0xd8};
  constexpr std::array<std::uint8_t, 2> kEnd = {0xff, 0xd9};
  if (data.size() < 4 || !std::equal(kStart.begin(), kStart.end(), data.begin())) return false;
  constexpr std::size_t kPadding = 4096;
  const auto tail = static_cast<std::ptrdiff_t>(std::min(data.size(), kPadding));
  return std::search(data.end() - tail, data.end(), kEnd.begin(), kEnd.end()) == data.end();
}

cv::Mat decode(const sensor_msgs::CompressedImage& message) {
  if (isCutJpeg(message.data)) refuse(message, "is cut short: its JPEG does not end");
  cv::Mat pixels;
  try {
    if (!message.data.empty()) pixels = cv::imdecode(message.data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    pixels.release();  // said below
  }
  if (pixels.empty()) refuse(message, "cannot be decoded");
  return pixels;
}

// What decoded pixels are if the format does not say it.
std::string plainEncoding(const cv::Mat& pixels) {
  const bool deep = pixels.depth() == CV_16U;
  if (pixels.type() == CV_32FC1) return encodings::TYPE_32FC1;
  if (pixels.channels() == 1) return deep ? encodings::TYPE_16UC1 : encodings::MONO8;
  if (pixels.channels() == 3) return deep ? encodings::BGR16 : encodings::BGR8;
  return deep ? encodings::BGRA16 : encodings::BGRA8;
}

bool holds(const std::string& encoding, int type) {
  try {
    return cv_bridge::getCvType(encoding) == type;
  } catch (const cv_bridge::Exception&) {
    return false;
  }
}

}  // namespace

sensor_msgs::CompressedImage compressImage(const sensor_msgs::Image& message, int jpeg_quality) {
  sensor_msgs::CompressedImage out;
  out.header = message.header;
  try {
    auto image = cv_bridge::toCvShare(message, nullptr);
    const int depth = image->image.depth();
    if (depth != CV_8U && depth != CV_16U)
      refuse(message, "give 8 bits per channel or 16, depth as 16UC1 in millimetres");
    std::string stored;
    if (encodings::isColor(message.encoding)) {
      stored = storedColor(depth == CV_16U ? 16 : 8);
      image = cv_bridge::cvtColor(image, stored);
    }
    const int channels = image->image.channels();
    if (channels != 1 && channels != 3) refuse(message, "give grey or colour");
    const bool png = depth == CV_16U;
    out.format = message.encoding + (png ? "; png" : "; jpeg") + " compressed " + stored;
    // Level 1 packs depth as well as higher ones, in a fraction of the time.
    const std::vector<int> settings =
        png ? std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, 1}
            : std::vector<int>{cv::IMWRITE_JPEG_QUALITY, std::clamp(jpeg_quality, 1, 100)};
    if (!cv::imencode(png ? ".png" : ".jpg", image->image, out.data, settings))
      refuse(message, "the encoder fails");
  } catch (const cv_bridge::Exception& error) {
    refuse(message, error.what());
  } catch (const cv::Exception& error) {
    refuse(message, error.what());
  }
  return out;
}

sensor_msgs::ImagePtr decompressImage(const sensor_msgs::CompressedImage& message) {
  cv_bridge::CvImage image(message.header, "", decode(message));
  const auto end = message.format.find(';');
  const std::string original = end == std::string::npos ? "" : message.format.substr(0, end);
  if (!encodings::isColor(original) && holds(original, image.image.type())) {
    image.encoding = original;
    return image.toImageMsg();
  }
  image.encoding = plainEncoding(image.image);
  if (!encodings::isColor(original) || !encodings::isColor(image.encoding) ||
      image.encoding == original)
    return image.toImageMsg();
  // Other writers keep the order red, green, blue and say so.
  if (message.format.find("compressed rgb") != std::string::npos && image.image.channels() == 3)
    image.encoding = image.image.depth() == CV_16U ? encodings::RGB16 : encodings::RGB8;
  try {
    return cv_bridge::cvtColor(boost::make_shared<const cv_bridge::CvImage>(image), original)
        ->toImageMsg();
  } catch (const cv_bridge::Exception& error) {
    refuse(message, error.what());
  }
}

}  // namespace mvo_ros
