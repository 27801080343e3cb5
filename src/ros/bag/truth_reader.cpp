// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/truth_reader.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

#include "ros/bag/bag_frames.hpp"

namespace mvo_ros {

namespace {

const std::string kObjectPrefix = "/truth/object_";
constexpr std::size_t kMaxDigits = 9;  // of an id, fits into an int

// A mask as PNG: lossless, and a hundred times smaller.
using PackedMask = std::vector<unsigned char>;

struct Contents {
  mvo::Truth truth;
  std::set<std::int64_t> image_stamps;
  std::set<std::int64_t> truth_stamps;
  std::map<std::int64_t, PackedMask> masks;
};

std::int64_t stampOf(const std_msgs::Header& header) {
  return static_cast<std::int64_t>(header.stamp.toNSec());
}

std::optional<int> objectOf(const std::string& topic) {
  if (topic.rfind(kObjectPrefix, 0) != 0) return {};
  const std::string id = topic.substr(kObjectPrefix.size());
  if (id.empty() || id.size() > kMaxDigits ||
      id.find_first_not_of("0123456789") != std::string::npos)
    return {};
  return std::stoi(id);
}

mvo::StampedPose poseOf(const geometry_msgs::PoseStamped& message, const std::string& topic) {
  const auto& p = message.pose.position;
  const auto& q = message.pose.orientation;
  const Eigen::Quaterniond rotation(q.w, q.x, q.y, q.z);
  const Eigen::Vector3d translation(p.x, p.y, p.z);
  if (!translation.allFinite() || !(std::abs(rotation.norm() - 1) < 0.01))
    throw std::runtime_error(topic + " has a pose that is none");
  mvo::StampedPose pose;
  pose.stamp_ns = stampOf(message.header);
  pose.T_world_body.linear() = rotation.normalized().toRotationMatrix();
  pose.T_world_body.translation() = translation;
  return pose;
}

PackedMask packed(const sensor_msgs::Image& message) {
  if (message.encoding != "mono8" || message.step < message.width ||
      message.data.size() < static_cast<std::size_t>(message.step) * message.height)
    throw std::runtime_error("/truth/mask has an image that is not a whole mono8 one");
  const cv::Mat mask(static_cast<int>(message.height), static_cast<int>(message.width), CV_8UC1,
                     const_cast<unsigned char*>(message.data.data()), message.step);
  PackedMask bytes;
  cv::imencode(".png", mask, bytes, {cv::IMWRITE_PNG_COMPRESSION, 1});
  return bytes;
}

void addVisibility(const sensor_msgs::PointCloud& message, mvo::Truth& truth) {
  const auto channel = [&](const std::string& name) {
    for (const auto& candidate : message.channels)
      if (candidate.name == name && candidate.values.size() == message.points.size())
        return candidate.values;
    throw std::runtime_error("/truth/objects has no channel " + name);
  };
  if (message.points.empty()) return;
  const auto ids = channel("id");
  const auto image_share = channel("visible_image_frac");
  const auto visible_share = channel("visible_frac");
  // The channels are float: round to what the tables of a sequence folder have, so that a share at
  // a limit stays at it.
  const auto rounded = [](float value) { return std::round(value * 1e6) / 1e6; };
  for (std::size_t i = 0; i < ids.size(); ++i) {
    mvo::BodyVisibility row;
    row.stamp_ns = stampOf(message.header);
    row.body = static_cast<int>(std::lround(ids[i]));
    row.image_share = rounded(image_share[i]);
    row.visible_share = rounded(visible_share[i]);
    truth.visibility.push_back(row);
  }
}

std::vector<std::string> imageTopics() {
  std::vector<std::string> topics;
  for (const Sensor sensor : {Sensor::kStereo, Sensor::kRgbd})
    for (const bool raw : {false, true}) {
      topics.push_back(usualTopics(sensor, raw).left);
      topics.push_back(topics.back() + "/compressed");
    }
  return topics;
}

void add(const rosbag::MessageInstance& message, const std::vector<std::string>& images,
         Contents& contents) {
  const std::string& topic = message.getTopic();
  if (std::find(images.begin(), images.end(), topic) != images.end()) {
    if (const auto image = message.instantiate<sensor_msgs::Image>())
      contents.image_stamps.insert(stampOf(image->header));
    else if (const auto bytes = message.instantiate<sensor_msgs::CompressedImage>())
      contents.image_stamps.insert(stampOf(bytes->header));
  } else if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>()) {
    const auto object = objectOf(topic);
    if (!object && topic != "/truth/camera") return;
    (object ? contents.truth.bodies[*object] : contents.truth.camera)
        .push_back(poseOf(*pose, topic));
    contents.truth_stamps.insert(stampOf(pose->header));
  } else if (topic == "/truth/mask") {
    const auto mask = message.instantiate<sensor_msgs::Image>();
    if (!mask) throw std::runtime_error("/truth/mask is no sensor_msgs/Image");
    contents.masks[stampOf(mask->header)] = packed(*mask);
    contents.truth_stamps.insert(stampOf(mask->header));
  } else if (topic == "/truth/objects") {
    const auto objects = message.instantiate<sensor_msgs::PointCloud>();
    if (!objects) throw std::runtime_error("/truth/objects is no sensor_msgs/PointCloud");
    addVisibility(*objects, contents.truth);
    contents.truth_stamps.insert(stampOf(objects->header));
  }
}

bool isTruth(const std::string& topic) { return topic.rfind("/truth/", 0) == 0; }

Contents readContents(const std::string& path) {
  rosbag::Bag bag(path, rosbag::bagmode::Read);
  const std::vector<std::string> images = imageTopics();
  rosbag::View view(bag, [&](const rosbag::ConnectionInfo* connection) {
    return isTruth(connection->topic) ||
           std::find(images.begin(), images.end(), connection->topic) != images.end();
  });
  Contents contents;
  for (const rosbag::MessageInstance& message : view) add(message, images, contents);
  return contents;
}

void sortByStamp(std::vector<mvo::StampedPose>& poses) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const auto& a, const auto& b) { return a.stamp_ns < b.stamp_ns; });
}

}  // namespace

mvo::Truth readTruthBag(const std::string& path) {
  Contents contents;
  try {
    contents = readContents(path);
  } catch (const std::exception& error) {
    throw std::runtime_error("cannot read the truth from " + path + ": " + error.what());
  }
  if (contents.truth_stamps.empty()) throw std::runtime_error(path + " has no truth topics");
  mvo::Truth& truth = contents.truth;
  const auto& stamps =
      contents.image_stamps.empty() ? contents.truth_stamps : contents.image_stamps;
  truth.stamps_ns.assign(stamps.begin(), stamps.end());
  sortByStamp(truth.camera);
  for (auto& [id, poses] : truth.bodies) sortByStamp(poses);
  if (!contents.masks.empty())
    truth.mask = [masks = std::make_shared<std::map<std::int64_t, PackedMask>>(
                      std::move(contents.masks)),
                  frames = truth.stamps_ns](std::size_t frame) {
      const auto found = masks->find(frames.at(frame));
      return found == masks->end() ? cv::Mat() : cv::imdecode(found->second, cv::IMREAD_GRAYSCALE);
    };
  return std::move(truth);
}

}  // namespace mvo_ros
