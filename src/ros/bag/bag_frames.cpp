// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/bag_frames.hpp"

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "io/stamp.hpp"
#include "ros/sensor/image_conversion.hpp"

namespace mvo_ros {

namespace {

constexpr char kCompressed[] = "/compressed";
constexpr double kForever = 9e9;  // [s], about as much as 64 bits of nanoseconds hold
constexpr char kMagic[] = "#ROSBAG V";

// The stamp of any message that begins with a header; its pixels stay unread.
struct StampOnly {
  ros::Time stamp;
};

[[noreturn]] void fail(const std::string& sentence) { throw std::runtime_error(sentence); }

std::int64_t nanoseconds(double seconds) { return std::llround(std::min(seconds, kForever) * 1e9); }

template <class Call>
double millisecondsOf(const Call& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

}  // namespace

}  // namespace mvo_ros

namespace ros {
namespace message_traits {
template <>
struct MD5Sum<mvo_ros::StampOnly> {
  static const char* value() { return "*"; }
  static const char* value(const mvo_ros::StampOnly&) { return value(); }
};
template <>
struct DataType<mvo_ros::StampOnly> {
  static const char* value() { return "*"; }
  static const char* value(const mvo_ros::StampOnly&) { return value(); }
};
}  // namespace message_traits
namespace serialization {
template <>
struct Serializer<mvo_ros::StampOnly> {
  template <class Stream>
  static void read(Stream& stream, mvo_ros::StampOnly& message) {
    std::uint32_t seq = 0;
    stream.next(seq);
    stream.next(message.stamp);
  }
};
}  // namespace serialization
}  // namespace ros

namespace mvo_ros {

BagFrames::BagFrames(const std::string& path, const BagRequest& request)
    : path_(path), request_(request) {
  openBag();
  findTopics();
  readCalibration();
  const std::vector<std::string> topics = {left_.topic, second_.topic};
  view_.emplace(bag_, rosbag::TopicQuery(topics));
  next_message_ = view_->begin();

  rosbag::View left_images(bag_, rosbag::TopicQuery(left_.topic));
  size_ = left_images.size();
  if (size_ == 0) fail("topic " + left_.topic + " has no messages in " + path_);
  if (rosbag::View(bag_, rosbag::TopicQuery(second_.topic)).size() == 0)
    fail("topic " + second_.topic + " has no messages in " + path_);
  const double seconds = (left_images.getEndTime() - left_images.getBeginTime()).toSec();
  if (!(seconds > 0)) return;
  rate_ = static_cast<double>(size_ - 1) / seconds;
  const double covered = seconds + 1 / rate_ - request_.start;  // each image stands for a period
  size_ =
      static_cast<std::size_t>(std::llround(std::clamp(covered, 0.0, request_.duration) * rate_));
}

void BagFrames::openBag() {
  std::error_code error;
  if (!std::filesystem::exists(path_, error)) fail(path_ + " does not exist");
  if (!std::filesystem::is_regular_file(path_, error)) fail(path_ + " is not a file");
  if (std::filesystem::file_size(path_, error) == 0) fail(path_ + " is empty (0 bytes)");
  std::string head(sizeof(kMagic) - 1, '\0');
  std::ifstream file(path_, std::ios::binary);
  if (!file) fail(path_ + " cannot be opened for reading");
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  if (head != kMagic) fail(path_ + " is not a bag");
  try {
    bag_.open(path_, rosbag::bagmode::Read);
  } catch (const rosbag::BagUnindexedException&) {
    fail(path_ +
         " has no index: it was cut off or is still being recorded (`rosbag reindex` may "
         "repair it)");
  } catch (const std::exception& exception) {
    fail(path_ + " cannot be read, it was cut off or damaged: " + exception.what());
  }
}

void BagFrames::findTopics() {
  std::map<std::string, std::string> types;
  for (const rosbag::ConnectionInfo* connection : rosbag::View(bag_).getConnections())
    types[connection->topic] = connection->datatype;
  if (types.empty()) fail(path_ + " holds no messages");

  std::string list;
  for (const auto& [topic, type] : types)
    list.append(list.empty() ? "" : ", ").append(topic).append(" (").append(type).append(")");
  const auto need = [&](const std::string& topic, const std::vector<std::string>& accepted) {
    if (types.count(topic) == 0)
      fail("topic " + topic + " is not in " + path_ + ", which has " + list);
    for (const std::string& type : accepted)
      if (types[topic] == type) return;
    fail("topic " + topic + " holds " + types[topic] + ", not " + accepted.front());
  };
  const auto image_stream = [&](const std::string& topic) {
    Stream stream;
    stream.topic = types.count(topic) == 0 && types.count(topic + kCompressed) != 0
                       ? topic + kCompressed
                       : topic;
    need(stream.topic, {"sensor_msgs/Image", "sensor_msgs/CompressedImage"});
    stream.compressed = types[stream.topic] == "sensor_msgs/CompressedImage";
    return stream;
  };
  left_ = image_stream(request_.setup.topics.left);
  second_ = image_stream(request_.setup.topics.second);
  second_.depth = request_.setup.sensor == Sensor::kRgbd;
  need(request_.setup.topics.left_info, {"sensor_msgs/CameraInfo"});
  if (request_.setup.sensor == Sensor::kStereo)
    need(request_.setup.topics.second_info, {"sensor_msgs/CameraInfo"});
}

sensor_msgs::CameraInfo BagFrames::firstInfo(const std::string& topic) {
  rosbag::View infos(bag_, rosbag::TopicQuery(topic));
  if (infos.size() == 0) fail("topic " + topic + " has no messages in " + path_);
  try {
    return *infos.begin()->instantiate<sensor_msgs::CameraInfo>();
  } catch (const std::exception& error) {
    fail("topic " + topic + " in " + path_ + " cannot be read: " + error.what());
  }
}

void BagFrames::readCalibration() {
  const SensorTopics& topics = request_.setup.topics;
  const sensor_msgs::CameraInfo left = firstInfo(topics.left_info);
  const sensor_msgs::CameraInfo second = request_.setup.sensor == Sensor::kStereo
                                             ? firstInfo(topics.second_info)
                                             : sensor_msgs::CameraInfo();
  model_.emplace(request_.setup, left, second);
}

bool BagFrames::advance() {
  while (!at_end_ && next_message_ != view_->end()) {
    const rosbag::MessageInstance& message = *next_message_;
    const bool is_left = message.getTopic() == left_.topic;
    Stream& stream = is_left ? left_ : second_;
    const auto header = message.instantiate<StampOnly>();
    const auto stamp_ns = static_cast<std::int64_t>(header->stamp.toNSec());
    if (stream.last_stamp_ns && stamp_ns <= *stream.last_stamp_ns)
      fail("topic " + stream.topic + ": the stamps do not increase, " + mvo::formatStamp(stamp_ns) +
           " follows " + mvo::formatStamp(*stream.last_stamp_ns));
    stream.last_stamp_ns = stamp_ns;
    if (!first_stamp_ns_) first_stamp_ns_ = stamp_ns;
    const std::int64_t since_start_ns = stamp_ns - *first_stamp_ns_ - nanoseconds(request_.start);
    const bool after_end = since_start_ns >= nanoseconds(request_.duration);
    const bool wanted = since_start_ns >= 0 && !after_end;
    if (wanted) stream.waiting.push_back({stamp_ns, message});
    if (wanted && is_left) ++position_;
    (is_left ? left_ : second_).past_end = after_end;
    if (left_.past_end && second_.past_end) at_end_ = true;
    ++next_message_;
    if (wanted) return true;
  }
  return false;
}

// Both streams are in order, so the earlier of the two fronts is paired now or never.
std::optional<std::pair<BagFrames::Stream::Entry, BagFrames::Stream::Entry>> BagFrames::nextPair() {
  const std::int64_t tolerance_ns = nanoseconds(request_.sync_tolerance);
  const auto distance = [](const Stream::Entry& a, const Stream::Entry& b) {
    return std::abs(a.stamp_ns - b.stamp_ns);
  };
  while (true) {
    while ((left_.waiting.empty() || second_.waiting.empty()) && advance()) {
    }
    if (left_.waiting.empty() || second_.waiting.empty()) {
      unpaired_ += left_.waiting.size() + second_.waiting.size();
      left_.waiting.clear();
      second_.waiting.clear();
      return std::nullopt;
    }
    const bool left_first = left_.waiting.front().stamp_ns <= second_.waiting.front().stamp_ns;
    Stream& early = left_first ? left_ : second_;
    const Stream& late = left_first ? second_ : left_;
    bool pair = distance(early.waiting[0], late.waiting[0]) <= tolerance_ns;
    if (pair && distance(early.waiting[0], late.waiting[0]) > 0) {
      while (early.waiting.size() < 2 && advance()) {
      }
      if (early.waiting.size() > 1)
        pair = distance(early.waiting[0], late.waiting[0]) <=
               distance(early.waiting[1], late.waiting[0]);
    }
    if (pair) {
      const std::pair<Stream::Entry, Stream::Entry> found(left_.waiting.front(),
                                                          second_.waiting.front());
      left_.waiting.pop_front();
      second_.waiting.pop_front();
      return found;
    }
    early.waiting.pop_front();
    ++unpaired_;
  }
}

cv::Mat BagFrames::image(const Stream& stream, const Stream::Entry& entry) const {
  const auto convert = [&stream](const auto& message) {
    return stream.depth ? depthImage(message) : greyImage(message);
  };
  const std::string where = "topic " + stream.topic + ", stamp " + mvo::formatStamp(entry.stamp_ns);
  cv::Mat pixels;
  try {
    pixels = stream.compressed ? convert(*entry.message.instantiate<sensor_msgs::CompressedImage>())
                               : convert(*entry.message.instantiate<sensor_msgs::Image>());
  } catch (const std::runtime_error& error) {
    fail(where + ": " + error.what());
  }
  if (pixels.cols != camera().width || pixels.rows != camera().height)
    fail(where + ": the image has " + std::to_string(pixels.cols) + "x" +
         std::to_string(pixels.rows) + " pixels, but the calibration (" +
         request_.setup.topics.left_info + ") is for " + std::to_string(camera().width) + "x" +
         std::to_string(camera().height));
  return pixels;
}

std::optional<BagFrame> BagFrames::next() {
  try {
    const auto pair = nextPair();
    if (!pair) return std::nullopt;
    BagFrame out;
    cv::Mat left;
    cv::Mat second;
    out.decode_ms = millisecondsOf([&] {
      left = image(left_, pair->first);
      second = image(second_, pair->second);
    });
    out.rectify_ms =
        millisecondsOf([&] { out.frame = model_->frame(pair->first.stamp_ns, left, second); });
    if (!model_->rectifies()) out.rectify_ms = 0;
    return out;
  } catch (const ros::Exception& error) {
    fail(path_ + " is damaged: " + error.what());
  }
}

}  // namespace mvo_ros
