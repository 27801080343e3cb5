// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/input_watch.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace mvo_ros {

InputWatch::InputWatch(const std::vector<std::string>& topics, double now) : last_set_(now) {
  for (const std::string& name : topics) {
    Topic topic;
    topic.name = name;
    topics_.push_back(topic);
  }
}

void InputWatch::message(std::size_t topic, double stamp) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ++topics_[topic].messages;
  topics_[topic].stamp = stamp;
}

void InputWatch::completeSet(double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  last_set_ = now;
}

double InputWatch::silence(double now) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return now - last_set_;
}

std::string InputWatch::report(const std::vector<std::size_t>& publishers, double now) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::ostringstream out;
  out << std::fixed << std::setprecision(1) << "no synchronized set for " << now - last_set_
      << " s; ";
  std::optional<double> newest;
  for (const Topic& t : topics_)
    if (t.stamp) newest = std::max(newest.value_or(*t.stamp), *t.stamp);
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    Topic& t = topics_[i];
    const std::uint64_t fresh = t.messages - t.reported;
    t.reported = t.messages;
    out << (i == 0 ? "" : ", ") << t.name << ": ";
    if (publishers[i] == 0)
      out << "no publisher";
    else
      out << publishers[i] << (publishers[i] == 1 ? " publisher" : " publishers");
    out << ", " << fresh << " messages";
    if (t.stamp)
      out << ", stamp " << std::setprecision(3) << *newest - *t.stamp << " s behind the newest"
          << std::setprecision(1);
  }
  return out.str();
}

}  // namespace mvo_ros
