// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// A sensor's topics as sets of messages that belong together.
#pragma once

#include <image_transport/image_transport.h>
#include <image_transport/subscriber_filter.h>
#include <message_filters/subscriber.h>
#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/sync_policies/exact_time.h>
#include <message_filters/synchronizer.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <array>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "ros/live/input_watch.hpp"
#include "ros/parameters/node_options.hpp"
#include "ros/sensor/sensor_model.hpp"

namespace mvo_ros {

/// One set, as it came; for RGB-D `second` is the depth and `second_info` null.
struct InputSet {
  sensor_msgs::ImageConstPtr left;
  sensor_msgs::ImageConstPtr second;
  sensor_msgs::CameraInfoConstPtr left_info;
  sensor_msgs::CameraInfoConstPtr second_info;
  ros::WallTime arrival;
};

/// Subscribes and hands on every set whose stamps agree.
class SynchronizedInput {
 public:
  using Callback = std::function<void(const InputSet&)>;

  /// Throws std::invalid_argument naming the transport if it is not installed (image_transport
  /// itself would end the process).
  SynchronizedInput(Sensor sensor, const NodeOptions& options, ros::NodeHandle nh,
                    const ros::NodeHandle& pnh, Callback callback);

  ~SynchronizedInput();

  /// Resolved names.
  const SensorTopics& topics() const { return topics_; }
  /// Seconds since the last set.
  double silence() const;
  /// Why there is none.
  std::string report();

 private:
  using Image = sensor_msgs::Image;
  using Info = sensor_msgs::CameraInfo;
  template <class Policy>
  using Sync = message_filters::Synchronizer<Policy>;
  template <class... Messages>
  using Exact = message_filters::sync_policies::ExactTime<Messages...>;
  template <class... Messages>
  using Approximate = message_filters::sync_policies::ApproximateTime<Messages...>;

  // Where messages wait for those they belong to.
  struct Matching {
    std::function<void(const sensor_msgs::ImageConstPtr&)> left;
    std::function<void(const sensor_msgs::CameraInfoConstPtr&)> left_info;
    std::function<void(const sensor_msgs::ImageConstPtr&)> second;
    std::function<void(const sensor_msgs::CameraInfoConstPtr&)> second_info;
  };

  template <class Policy>
  std::shared_ptr<const Matching> matchStereo(const Policy& policy);
  template <class Policy>
  std::shared_ptr<const Matching> matchRgbd(const Policy& policy);
  std::shared_ptr<const Matching> match(Sensor sensor, const NodeOptions& options);
  // Counts a message of a topic, by its place in the list. A topic whose time goes back begins a
  // new matching: what waits for partners from then would displace what comes.
  std::shared_ptr<const Matching> noted(std::size_t topic, const std_msgs::Header& header);
  void onStereo(const sensor_msgs::ImageConstPtr& left, const sensor_msgs::ImageConstPtr& right,
                const sensor_msgs::CameraInfoConstPtr& left_info,
                const sensor_msgs::CameraInfoConstPtr& right_info);
  void onRgbd(const sensor_msgs::ImageConstPtr& rgb, const sensor_msgs::ImageConstPtr& depth,
              const sensor_msgs::CameraInfoConstPtr& info);
  void emit(InputSet set);

  Callback callback_;
  SensorTopics topics_;
  std::unique_ptr<InputWatch> watch_;
  image_transport::ImageTransport transport_;
  image_transport::SubscriberFilter left_;
  image_transport::SubscriberFilter second_;
  message_filters::Subscriber<Info> left_info_;
  message_filters::Subscriber<Info> second_info_;
  std::function<std::shared_ptr<const Matching>()> new_matching_;
  std::mutex mutex_;  // of the following
  std::shared_ptr<const Matching> matching_;
  std::array<ros::Time, 4> newest_;
};

}  // namespace mvo_ros
