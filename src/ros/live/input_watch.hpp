// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Why nothing arrives: what each topic has sent, and how far apart the stamps are.
#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace mvo_ros {

/// Counts messages per topic and complete sets. Safe from any thread. Times are of any steady
/// clock [s].
class InputWatch {
 public:
  explicit InputWatch(const std::vector<std::string>& topics, double now);

  /// A message of a topic, by its place in the list; stamps in seconds.
  void message(std::size_t topic, double stamp);
  void completeSet(double now);

  /// Seconds since the last complete set, or since the beginning.
  double silence(double now) const;
  /// One sentence that names each topic, its number of publishers, its messages since the last
  /// call, and the gaps between the newest stamps.
  std::string report(const std::vector<std::size_t>& publishers, double now);

 private:
  struct Topic {
    std::string name;
    std::uint64_t messages = 0;
    std::uint64_t reported = 0;
    std::optional<double> stamp;  // newest
  };

  mutable std::mutex mutex_;
  std::vector<Topic> topics_;
  double last_set_;
};

}  // namespace mvo_ros
