// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Everything that a topic said, in order.
#pragma once

#include <diagnostic_msgs/DiagnosticArray.h>
#include <ros/ros.h>
#include <rosgraph_msgs/Log.h>

#include <mutex>
#include <string>
#include <vector>

#include "support/eventually.hpp"

namespace mvo::test {

/// Subscribes and keeps all messages. Safe from any thread.
template <class Message>
class Recorder {
 public:
  explicit Recorder(const std::string& topic)
      : subscriber_(ros::NodeHandle().subscribe<Message>(
            topic, kQueue, [this](const boost::shared_ptr<const Message>& m) { add(m); })) {}
  ~Recorder() { subscriber_.shutdown(); }
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  bool connected() const { return subscriber_.getNumPublishers() > 0; }
  std::vector<boost::shared_ptr<const Message>> all() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_;
  }
  std::size_t size() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.size();
  }
  /// The newest; throws if there is none.
  boost::shared_ptr<const Message> last() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages_.at(messages_.size() - 1);
  }
  /// The first with a header's stamp among all but the oldest; null if there is none.
  boost::shared_ptr<const Message> stamped(const ros::Time& stamp, std::size_t oldest) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t i = oldest; i < messages_.size(); ++i)
      if (messages_[i]->header.stamp == stamp) return messages_[i];
    return nullptr;
  }
  void clear() {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.clear();
  }

 private:
  static constexpr unsigned kQueue = 10000;

  void add(const boost::shared_ptr<const Message>& message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.push_back(message);
  }

  mutable std::mutex mutex_;
  std::vector<boost::shared_ptr<const Message>> messages_;
  ros::Subscriber subscriber_;
};

/// Whether a text contains all of some parts.
inline bool says(const std::string& text, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    if (text.find(part) == std::string::npos) return false;
  return true;
}

/// What a node reports on /diagnostics.
class DiagnosticsRecorder {
 public:
  explicit DiagnosticsRecorder(std::string node) : node_(std::move(node)), topic_("/diagnostics") {}

  /// All reports so far, oldest first.
  std::vector<diagnostic_msgs::DiagnosticStatus> all() const {
    std::vector<diagnostic_msgs::DiagnosticStatus> out;
    for (const auto& array : topic_.all())
      for (const auto& status : array->status)
        if (status.name.rfind(node_ + ": ", 0) == 0) out.push_back(status);
    return out;
  }
  /// Whether some report's sentence contains all parts.
  bool said(const std::vector<std::string>& parts) const {
    for (const auto& status : all())
      if (says(status.message, parts)) return true;
    return false;
  }
  /// Of the newest report; empty without one.
  std::string message() const {
    const auto reports = all();
    return reports.empty() ? "" : reports.back().message;
  }
  std::string value(const std::string& key) const {
    const auto reports = all();
    if (!reports.empty())
      for (const auto& pair : reports.back().values)
        if (pair.key == key) return pair.value;
    return "";
  }
  void clear() { topic_.clear(); }

 private:
  std::string node_;
  Recorder<diagnostic_msgs::DiagnosticArray> topic_;
};

/// What a node wrote into the log.
class LogRecorder {
 public:
  explicit LogRecorder(std::string node) : node_(std::move(node)), topic_("/rosout") {}

  bool said(const std::vector<std::string>& parts) const {
    for (const auto& line : topic_.all())
      if (line->name == node_ && says(line->msg, parts)) return true;
    return false;
  }
  void clear() { topic_.clear(); }

 private:
  std::string node_;
  Recorder<rosgraph_msgs::Log> topic_;
};

}  // namespace mvo::test
