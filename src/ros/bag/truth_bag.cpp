// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/bag/truth_bag.hpp"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>
#include <utility>

#include "ros/sensor/camera_info_message.hpp"

namespace mvo_ros {
namespace {

namespace encodings = sensor_msgs::image_encodings;

sensor_msgs::Image imageMessage(const std_msgs::Header& header, const std::string& encoding,
                                const cv::Mat& image) {
  return *cv_bridge::CvImage(header, encoding, image).toImageMsg();
}

geometry_msgs::PoseStamped poseMessage(std_msgs::Header header, const Eigen::Isometry3d& T) {
  geometry_msgs::PoseStamped message;
  message.header = std::move(header);
  message.header.frame_id = "world";
  const Eigen::Quaterniond q(T.linear());
  message.pose.position.x = T.translation().x();
  message.pose.position.y = T.translation().y();
  message.pose.position.z = T.translation().z();
  message.pose.orientation.x = q.x();
  message.pose.orientation.y = q.y();
  message.pose.orientation.z = q.z();
  message.pose.orientation.w = q.w();
  return message;
}

sensor_msgs::PointCloud objectsMessage(const std_msgs::Header& header,
                                       const mvo::SequenceFrame& frame) {
  using mvo::BodyVisibility;
  using Value = double (*)(const BodyVisibility&);
  const std::pair<const char*, Value> values[] = {
      {"id", [](const BodyVisibility& o) { return 1.0 * o.body; }},
      {"visible_px", [](const BodyVisibility& o) { return 1.0 * o.visible_px; }},
      {"visible_image_frac", [](const BodyVisibility& o) { return o.image_share; }},
      {"silhouette_px", [](const BodyVisibility& o) { return 1.0 * o.silhouette_px; }},
      {"inframe_frac", [](const BodyVisibility& o) { return o.inframe_share; }},
      {"visible_frac", [](const BodyVisibility& o) { return o.visible_share; }}};
  sensor_msgs::PointCloud cloud;
  cloud.header = header;
  cloud.channels.resize(1);
  cloud.channels[0].name = "frame";
  cloud.channels[0].values.assign(frame.objects.size(), static_cast<float>(header.seq));
  for (const auto& [name, value] : values) {
    sensor_msgs::ChannelFloat32 channel;
    channel.name = name;
    for (const BodyVisibility& object : frame.objects) {
      channel.values.push_back(static_cast<float>(value(object)));
    }
    cloud.channels.push_back(std::move(channel));
  }
  for (const BodyVisibility& object : frame.objects) {
    const Eigen::Vector3d p_camera =
        frame.T_world_camera->inverse() * frame.T_world_bodies.at(object.body).translation();
    geometry_msgs::Point32 point;
    point.x = static_cast<float>(p_camera.x());
    point.y = static_cast<float>(p_camera.y());
    point.z = static_cast<float>(p_camera.z());
    cloud.points.push_back(point);
  }
  return cloud;
}

}  // namespace

TruthBag::TruthBag(const std::string& path, const mvo::SequenceInfo& info)
    : path_(path), info_(info) {
  try {
    bag_.open(path, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path + " cannot be written: " + error.what());
  }
}

template <typename Message>
void TruthBag::write(const std::string& topic, const Message& message) {
  try {
    bag_.write(topic, message.header.stamp, message);
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path_ + " cannot be written: " + error.what());
  }
}

void TruthBag::add(const mvo::SequenceFrame& frame) {
  std_msgs::Header header;
  header.seq = frames_;
  header.stamp.fromNSec(static_cast<std::uint64_t>(frame.stamp_ns));
  header.frame_id = info_.rgbd ? "camera_rgb_optical_frame" : "stereo_left_optical";
  writeImages(frame, header);
  writeTruth(frame, header);
  ++frames_;
}

void TruthBag::writeImages(const mvo::SequenceFrame& frame, const std_msgs::Header& header) {
  const auto left_info = cameraInfo(header, info_.camera, 0);
  if (info_.rgbd) {
    write("/camera/rgb/image_rect_color", imageMessage(header, encodings::BGR8, frame.left));
    write("/camera/rgb/camera_info", left_info);
    write("/camera/depth_registered/image_rect",
          imageMessage(header, encodings::TYPE_16UC1, frame.right));
    return;
  }
  write("/stereo/left/image_rect", imageMessage(header, encodings::MONO8, frame.left));
  write("/stereo/left/camera_info", left_info);
  write("/stereo/right/image_rect", imageMessage(header, encodings::MONO8, frame.right));
  write("/stereo/right/camera_info", cameraInfo(header, info_.camera, info_.camera.baseline));
}

void TruthBag::writeTruth(const mvo::SequenceFrame& frame, const std_msgs::Header& header) {
  if (frame.T_world_camera) write("/truth/camera", poseMessage(header, *frame.T_world_camera));
  for (const auto& [id, T_world_body] : frame.T_world_bodies) {
    write("/truth/object_" + std::to_string(id), poseMessage(header, T_world_body));
  }
  if (!frame.mask.empty()) {
    write("/truth/mask", imageMessage(header, encodings::MONO8, frame.mask));
  }
  if (!frame.objects.empty() && frame.T_world_camera) {
    write("/truth/objects", objectsMessage(header, frame));
  }
}

void TruthBag::close() {
  try {
    bag_.close();
  } catch (const rosbag::BagException& error) {
    throw std::runtime_error(path_ + " cannot be written: " + error.what());
  }
}

}  // namespace mvo_ros
