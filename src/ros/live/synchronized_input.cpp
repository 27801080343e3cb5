// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/synchronized_input.hpp"

#include <boost/bind/bind.hpp>
#include <stdexcept>

namespace mvo_ros {

namespace {

constexpr unsigned kSubscriberQueue = 10;

double secondsNow() { return ros::SteadyTime::now().toSec(); }

void requireTransport(const image_transport::ImageTransport& transport, const std::string& option,
                      const std::string& name) {
  std::string list;
  for (const std::string& full : transport.getLoadableTransports()) {
    const std::string known = full.substr(full.find('/') + 1);
    if (known == name) return;
    list += (list.empty() ? "" : ", ") + known;
  }
  throw std::invalid_argument("option " + option + " is '" + name +
                              "', but only these are installed: " + list);
}

}  // namespace

SynchronizedInput::SynchronizedInput(Sensor sensor, const NodeOptions& options, ros::NodeHandle nh,
                                     const ros::NodeHandle& pnh, Callback callback)
    : callback_(std::move(callback)), transport_(nh) {
  const std::string& second_transport =
      sensor == Sensor::kRgbd ? options.depth_transport : options.image_transport;
  requireTransport(transport_, "image_transport", options.image_transport);
  requireTransport(transport_, "depth_transport", second_transport);
  topics_ = relativeTopics(sensor, options.rectify);
  for (std::string* name :
       {&topics_.left, &topics_.left_info, &topics_.second, &topics_.second_info})
    if (!name->empty()) *name = nh.resolveName(*name);
  std::vector<std::string> names = {topics_.left, topics_.left_info, topics_.second};
  if (sensor == Sensor::kStereo) names.push_back(topics_.second_info);
  watch_ = std::make_unique<InputWatch>(names, secondsNow());

  new_matching_ = [this, sensor, options] { return match(sensor, options); };
  matching_ = new_matching_();
  left_.registerCallback([this](const auto& m) { noted(0, m->header)->left(m); });
  left_info_.registerCallback([this](const auto& m) { noted(1, m->header)->left_info(m); });
  second_.registerCallback([this](const auto& m) { noted(2, m->header)->second(m); });
  second_info_.registerCallback([this](const auto& m) { noted(3, m->header)->second_info(m); });

  // Without a parameter of their own: the option is checked, a parameter is not.
  const auto hints = [&pnh](const std::string& name) {
    return image_transport::TransportHints(name, ros::TransportHints(), pnh, "live/none");
  };
  left_.subscribe(transport_, topics_.left, kSubscriberQueue, hints(options.image_transport));
  second_.subscribe(transport_, topics_.second, kSubscriberQueue, hints(second_transport));
  left_info_.subscribe(nh, topics_.left_info, kSubscriberQueue);
  if (sensor == Sensor::kStereo) second_info_.subscribe(nh, topics_.second_info, kSubscriberQueue);
}

// No callback may be under way when the filters end.
SynchronizedInput::~SynchronizedInput() {
  left_.unsubscribe();
  second_.unsubscribe();
  left_info_.unsubscribe();
  second_info_.unsubscribe();
}

template <class Policy>
std::shared_ptr<const SynchronizedInput::Matching> SynchronizedInput::matchStereo(
    const Policy& policy) {
  auto sync = std::make_shared<Sync<Policy>>(policy);
  sync->registerCallback(boost::bind(&SynchronizedInput::onStereo, this, boost::placeholders::_1,
                                     boost::placeholders::_2, boost::placeholders::_3,
                                     boost::placeholders::_4));
  return std::make_shared<Matching>(Matching{[sync](const auto& m) { sync->template add<0>(m); },
                                             [sync](const auto& m) { sync->template add<2>(m); },
                                             [sync](const auto& m) { sync->template add<1>(m); },
                                             [sync](const auto& m) { sync->template add<3>(m); }});
}

template <class Policy>
std::shared_ptr<const SynchronizedInput::Matching> SynchronizedInput::matchRgbd(
    const Policy& policy) {
  auto sync = std::make_shared<Sync<Policy>>(policy);
  sync->registerCallback(boost::bind(&SynchronizedInput::onRgbd, this, boost::placeholders::_1,
                                     boost::placeholders::_2, boost::placeholders::_3));
  return std::make_shared<Matching>(Matching{[sync](const auto& m) { sync->template add<0>(m); },
                                             [sync](const auto& m) { sync->template add<2>(m); },
                                             [sync](const auto& m) { sync->template add<1>(m); },
                                             nullptr});
}

std::shared_ptr<const SynchronizedInput::Matching> SynchronizedInput::match(
    Sensor sensor, const NodeOptions& options) {
  const auto queue = static_cast<unsigned>(options.sync_queue);
  const bool stereo = sensor == Sensor::kStereo;
  if (!options.approximate_sync) {
    if (stereo) return matchStereo(Exact<Image, Image, Info, Info>(queue));
    return matchRgbd(Exact<Image, Image, Info>(queue));
  }
  const auto within = [&options](auto policy) {
    policy.setMaxIntervalDuration(ros::Duration(options.max_interval));
    return policy;
  };
  if (stereo) return matchStereo(within(Approximate<Image, Image, Info, Info>(queue)));
  return matchRgbd(within(Approximate<Image, Image, Info>(queue)));
}

std::shared_ptr<const SynchronizedInput::Matching> SynchronizedInput::noted(
    std::size_t topic, const std_msgs::Header& header) {
  watch_->message(topic, header.stamp.toSec());
  const std::lock_guard<std::mutex> lock(mutex_);
  if (header.stamp.isZero()) return matching_;  // not stamped at all
  if (header.stamp < newest_.at(topic)) {
    matching_ = new_matching_();
    newest_.fill(ros::Time());
  }
  newest_.at(topic) = header.stamp;
  return matching_;
}

void SynchronizedInput::onStereo(const sensor_msgs::ImageConstPtr& left,
                                 const sensor_msgs::ImageConstPtr& right,
                                 const sensor_msgs::CameraInfoConstPtr& left_info,
                                 const sensor_msgs::CameraInfoConstPtr& right_info) {
  emit({left, right, left_info, right_info, {}});
}

void SynchronizedInput::onRgbd(const sensor_msgs::ImageConstPtr& rgb,
                               const sensor_msgs::ImageConstPtr& depth,
                               const sensor_msgs::CameraInfoConstPtr& info) {
  emit({rgb, depth, info, nullptr, {}});
}

void SynchronizedInput::emit(InputSet set) {
  watch_->completeSet(secondsNow());
  set.arrival = ros::WallTime::now();
  callback_(set);
}

double SynchronizedInput::silence() const { return watch_->silence(secondsNow()); }

std::string SynchronizedInput::report() {
  std::vector<std::size_t> publishers = {left_.getNumPublishers(),
                                         left_info_.getSubscriber().getNumPublishers(),
                                         second_.getNumPublishers()};
  if (!topics_.second_info.empty())
    publishers.push_back(second_info_.getSubscriber().getNumPublishers());
  return watch_->report(publishers, secondsNow());
}

}  // namespace mvo_ros
