// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// image_transport's "compressed" where the system has none: Debian ships no
// image_transport_plugins. Library, classes and compressed_plugins.xml carry the names of
// compressed_image_transport's own, so that it makes no difference which of the two declarations a
// program meets first.
#include <image_transport/simple_publisher_plugin.h>
#include <image_transport/simple_subscriber_plugin.h>

#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>
#include <string>

#include "ros/compressed/compressed_image.hpp"

namespace compressed_image_transport {

namespace {

constexpr double kThrottle = 5;  // s

}  // namespace

class CompressedPublisher
    : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  using Base = image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage>;
  using Base::publish;

  void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const override {
    try {
      publish_fn(mvo_ros::compressImage(message, quality()));
    } catch (const std::runtime_error& error) {
      ROS_ERROR_STREAM_THROTTLE(kThrottle, "topic " << getTopic() << ": " << error.what());
    }
  }

 private:
  // <topic>/compressed/jpeg_quality may change at any time.
  int quality() const {
    int quality = mvo_ros::kUsualJpegQuality;
    if (!nh().getParamCached("jpeg_quality", quality)) return quality;
    if (quality >= 1 && quality <= 100) return quality;
    ROS_ERROR_STREAM_THROTTLE(kThrottle, "parameter " << getTopic() << "/jpeg_quality is "
                                                      << quality << ", it must be in [1, 100]");
    return mvo_ros::kUsualJpegQuality;
  }
};

class CompressedSubscriber
    : public image_transport::SimpleSubscriberPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void internalCallback(const sensor_msgs::CompressedImageConstPtr& message,
                        const Callback& user_cb) override {
    sensor_msgs::ImagePtr image;
    try {
      image = mvo_ros::decompressImage(*message);
    } catch (const std::runtime_error& error) {
      ROS_ERROR_STREAM_THROTTLE(kThrottle, "topic " << getTopic() << ": " << error.what());
      return;
    }
    user_cb(image);
  }
};

}  // namespace compressed_image_transport

PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedPublisher,
                       image_transport::PublisherPlugin)
PLUGINLIB_EXPORT_CLASS(compressed_image_transport::CompressedSubscriber,
                       image_transport::SubscriberPlugin)
