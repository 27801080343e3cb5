// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A camera driver over the simulator: images rendered once into memory and published as asked.
#pragma once

#include <cv_bridge/cv_bridge.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <future>
#include <string>
#include <vector>

#include "mvo/sim.hpp"
#include "ros/sensor/camera_info_message.hpp"
#include "support/eventually.hpp"

namespace mvo::test {

/// Images of a scene, small enough for instrumented programs.
struct Recording {
  mvo::StereoCamera camera;
  double rate_hz = 15;
  std::vector<mvo::sim::RenderedFrame> frames;
};

/// Four blocks swing and turn before a moving camera.
inline Recording recordBlocks(int frames, mvo::sim::SceneOptions options = {}, int width = 320,
                              int height = 240) {
  options.width = width;
  options.height = height;
  const mvo::sim::Scene scene = mvo::sim::makeScene("blocks", 1, options);
  Recording out{scene.camera, options.rate_hz, {}};
  out.frames.resize(static_cast<std::size_t>(frames));
  const auto renderEverySecond = [&](int first) {
    for (int k = first; k < frames; k += 2)
      out.frames[static_cast<std::size_t>(k)] = mvo::sim::render(scene, k);
  };
  const auto odd = std::async(std::launch::async, [&] { renderEverySecond(1); });
  renderEverySecond(0);
  odd.wait();
  return out;
}

/// Calibration as a driver sends it, not yet stamped; baseline 0 for the left camera.
inline sensor_msgs::CameraInfo infoMessage(const mvo::StereoCamera& camera, double baseline) {
  return mvo_ros::cameraInfo({}, camera, baseline);
}

inline sensor_msgs::Image imageMessage(const cv::Mat& pixels,
                                       const std::string& encoding = "mono8") {
  return *cv_bridge::CvImage({}, encoding, pixels).toImageMsg();
}

/// One set of messages; RGB-D leaves right_info alone.
struct CameraSet {
  sensor_msgs::Image left;
  sensor_msgs::Image right;
  sensor_msgs::CameraInfo left_info;
  sensor_msgs::CameraInfo right_info;
};

constexpr char kCameraFrame[] = "left_optical";

inline void stamp(CameraSet& set, const ros::Time& stamp,
                  const std::string& frame_id = kCameraFrame) {
  for (std_msgs::Header* header :
       {&set.left.header, &set.right.header, &set.left_info.header, &set.right_info.header}) {
    header->stamp = stamp;
    header->frame_id = frame_id;
  }
}

/// The stereo pair of a frame, not yet stamped.
inline CameraSet stereoSet(const Recording& recording, std::size_t k) {
  const auto& frame = recording.frames.at(k);
  return {imageMessage(frame.left), imageMessage(frame.right), infoMessage(recording.camera, 0),
          infoMessage(recording.camera, recording.camera.baseline)};
}

/// The colour image and its depth in millimetres, not yet stamped.
inline CameraSet rgbdSet(const Recording& recording, std::size_t k) {
  const auto& frame = recording.frames.at(k);
  cv::Mat millimetres;
  frame.depth.convertTo(millimetres, CV_16U, 1000);
  return {imageMessage(frame.color, "bgr8"), imageMessage(millimetres, "16UC1"),
          infoMessage(recording.camera, 0), infoMessage(recording.camera, 0)};
}

/// The topics of a camera. Publishing hands over to the transport and does not wait for the node.
class CameraTopics {
 public:
  /// Advertises; an empty name leaves a topic out.
  CameraTopics(const std::string& left, const std::string& left_info, const std::string& right,
               const std::string& right_info) {
    left_ = advertise<sensor_msgs::Image>(left);
    right_ = advertise<sensor_msgs::Image>(right);
    left_info_ = advertise<sensor_msgs::CameraInfo>(left_info);
    right_info_ = advertise<sensor_msgs::CameraInfo>(right_info);
  }
  static CameraTopics stereo(const std::string& ns = "") {
    return {ns + "/left/image_rect", ns + "/left/camera_info", ns + "/right/image_rect",
            ns + "/right/camera_info"};
  }
  static CameraTopics rgbd(const std::string& ns = "") {
    return {ns + "/rgb/image_rect_color", ns + "/rgb/camera_info",
            ns + "/depth_registered/image_rect", ""};
  }

  /// Waits until every topic has so many subscribers.
  bool connected(unsigned subscribers = 1) const {
    return eventually([&] {
      for (const ros::Publisher* p : {&left_, &right_, &left_info_, &right_info_})
        if (*p && p->getNumSubscribers() < subscribers) return false;
      return true;
    });
  }
  void publish(const CameraSet& set) const {
    publishLeft(set);
    publishRight(set);
  }
  void publishLeft(const CameraSet& set) const {
    if (left_info_) left_info_.publish(set.left_info);
    if (left_) left_.publish(set.left);
  }
  void publishRight(const CameraSet& set) const {
    if (right_info_) right_info_.publish(set.right_info);
    if (right_) right_.publish(set.right);
  }

 private:
  template <class Message>
  static ros::Publisher advertise(const std::string& topic) {
    return topic.empty() ? ros::Publisher() : ros::NodeHandle().advertise<Message>(topic, kQueue);
  }

  static constexpr unsigned kQueue = 100;
  ros::Publisher left_;
  ros::Publisher right_;
  ros::Publisher left_info_;
  ros::Publisher right_info_;
};

}  // namespace mvo::test
