// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The plugins as programs meet them: through image_transport, over a connection.
#include <cv_bridge/cv_bridge.h>
#include <gtest/gtest.h>
#include <image_transport/image_transport.h>

#include <algorithm>

#include "support/recorder.hpp"

namespace {

using mvo::test::eventually;
using mvo::test::LogRecorder;
using mvo::test::Recorder;

// Both ends of a topic; images come in by the transport named.
class Transport {
 public:
  explicit Transport(const std::string& topic)
      : packed(topic + "/compressed"), publisher_(transport_.advertise(topic, 10)) {
    subscriber_ = transport_.subscribe(
        topic, 10, [this](const sensor_msgs::ImageConstPtr& image) { add(image); }, {},
        image_transport::TransportHints("compressed"));
  }

  // Both subscribers are of one node and share its one connection.
  bool connected() const {
    return eventually([&] { return publisher_.getNumSubscribers() > 0; });
  }
  void publish(const std::string& encoding, const cv::Mat& pixels, unsigned seconds) const {
    std_msgs::Header header;
    header.stamp = ros::Time(seconds, 0);
    publisher_.publish(cv_bridge::CvImage(header, encoding, pixels).toImageMsg());
  }
  sensor_msgs::ImageConstPtr received(unsigned seconds) const {
    sensor_msgs::ImageConstPtr found;
    eventually([&] {
      const std::lock_guard<std::mutex> lock(mutex_);
      for (const auto& image : images_)
        if (image->header.stamp == ros::Time(seconds, 0)) found = image;
      return found != nullptr;
    });
    return found;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return images_.size();
  }

  Recorder<sensor_msgs::CompressedImage> packed;

 private:
  void add(const sensor_msgs::ImageConstPtr& image) {
    const std::lock_guard<std::mutex> lock(mutex_);
    images_.push_back(image);
  }

  mutable std::mutex mutex_;
  std::vector<sensor_msgs::ImageConstPtr> images_;
  image_transport::ImageTransport transport_{ros::NodeHandle()};
  image_transport::Publisher publisher_;
  image_transport::Subscriber subscriber_;
};

TEST(CompressedTransport, IsAnnounced) {
  const image_transport::ImageTransport transport{ros::NodeHandle()};
  const auto names = transport.getLoadableTransports();
  EXPECT_EQ(std::count(names.begin(), names.end(), "image_transport/compressed"), 1);
}

TEST(CompressedTransport, GreyArrives) {
  const Transport transport("/grey/image");
  ASSERT_TRUE(transport.connected());
  transport.publish("mono8", cv::Mat(480, 640, CV_8UC1, cv::Scalar(77)), 1);
  const auto image = transport.received(1);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->encoding, "mono8");
  EXPECT_EQ(image->width, 640U);
  EXPECT_NEAR(image->data[1000], 77, 1);
  ASSERT_TRUE(eventually([&] { return transport.packed.size() == 1; }));
  EXPECT_EQ(transport.packed.last()->format, "mono8; jpeg compressed ");
  EXPECT_LT(transport.packed.last()->data.size(), 640U * 480U / 10);
}

TEST(CompressedTransport, DepthArrivesExactly) {
  cv::Mat depth(48, 64, CV_16UC1);
  cv::randu(depth, 0, 65536);
  const Transport transport("/depth/image");
  ASSERT_TRUE(transport.connected());
  transport.publish("16UC1", depth, 1);
  const auto image = transport.received(1);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->encoding, "16UC1");
  EXPECT_EQ(cv::norm(cv_bridge::toCvShare(image)->image, depth, cv::NORM_INF), 0);
}

TEST(CompressedTransport, QualityIsAParameterAndMayChange) {
  cv::Mat texture(240, 320, CV_8UC1);
  cv::randu(texture, 0, 255);
  const Transport transport("/quality/image");
  ASSERT_TRUE(transport.connected());
  const auto bytes = [&](unsigned seconds) {
    transport.publish("mono8", texture, seconds);
    EXPECT_TRUE(eventually([&] { return transport.packed.size() == seconds; }));
    return transport.packed.last()->data.size();
  };
  const std::size_t usual = bytes(1);
  ros::param::set("/quality/image/compressed/jpeg_quality", 20);
  unsigned seconds = 1;  // the new value reaches the publisher when it does
  EXPECT_TRUE(eventually([&] { return bytes(++seconds) < usual / 2; }));
}

TEST(CompressedTransport, FloatingDepthIsRefusedInTheLog) {
  const LogRecorder log(ros::this_node::getName());
  const Transport transport("/floating/image");
  ASSERT_TRUE(transport.connected());
  transport.publish("32FC1", cv::Mat(48, 64, CV_32FC1, cv::Scalar(1)), 1);
  EXPECT_TRUE(eventually([&] {
    return log.said({"topic /floating/image/compressed", "'32FC1'", "16UC1"});
  }));
  transport.publish("mono8", cv::Mat(48, 64, CV_8UC1, cv::Scalar(1)), 2);
  EXPECT_NE(transport.received(2), nullptr);
  EXPECT_EQ(transport.size(), 1U);
}

TEST(CompressedTransport, BrokenMessageIsDroppedAndNamed) {
  const LogRecorder log(ros::this_node::getName());
  const Transport transport("/broken/image");
  ASSERT_TRUE(transport.connected());
  ros::Publisher raw =
      ros::NodeHandle().advertise<sensor_msgs::CompressedImage>("/broken/image/compressed", 10);
  ASSERT_TRUE(eventually([&] { return raw.getNumSubscribers() > 0; }));
  sensor_msgs::CompressedImage broken;
  broken.format = "mono8; jpeg compressed ";
  broken.data.assign(100, 0x55);
  raw.publish(broken);
  EXPECT_TRUE(eventually([&] {
    return log.said({"topic /broken/image/compressed", "cannot be decoded"});
  }));
  transport.publish("mono8", cv::Mat(48, 64, CV_8UC1, cv::Scalar(1)), 2);
  EXPECT_NE(transport.received(2), nullptr);
  EXPECT_EQ(transport.size(), 1U);
}

}  // namespace
