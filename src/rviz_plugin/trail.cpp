// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/trail.hpp"

#include <algorithm>

namespace mvo_rviz {

std::vector<Eigen::Vector3d> cutTrail(const std::vector<geometry_msgs::PoseStamped>& trajectory,
                                      int length) {
  const int limit = length <= 0 ? kLongestTrail : std::min(length, kLongestTrail);
  const std::size_t count = std::min(trajectory.size(), static_cast<std::size_t>(limit));
  std::vector<Eigen::Vector3d> trail;
  trail.reserve(count);
  for (std::size_t i = trajectory.size() - count; i < trajectory.size(); ++i) {
    const geometry_msgs::Point& p = trajectory[i].pose.position;
    trail.emplace_back(p.x, p.y, p.z);
  }
  return trail;
}

}  // namespace mvo_rviz
