// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The trajectories since the last reset, for saving them.
#pragma once

#include <Eigen/Geometry>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "mvo/trajectory_files.hpp"
#include "ros/live/odometry_session.hpp"

namespace mvo_ros {

/// Keeps the poses of the last `history` seconds, in the library's world (the left optical frame's
/// first pose), as rosrun mvo bag writes them.
class TrajectoryLog {
 public:
  explicit TrajectoryLog(double history) : history_(history) {}

  void add(const Step& step);
  /// Writes camera.tum and motion_<id>.tum into a folder, which is made if it is missing; returns
  /// the files. Throws std::runtime_error, one sentence, if the folder is no absolute path, a file
  /// exists or cannot be written; then nothing is left behind.
  std::vector<std::string> save(const std::string& folder) const;

 private:
  // Half the size of a transform: there are many.
  struct Pose {
    std::int64_t stamp_ns;
    Eigen::Vector3d translation;
    Eigen::Quaterniond rotation;
  };

  double history_;
  std::map<mvo::LabelId, std::deque<Pose>> poses_;
};

}  // namespace mvo_ros
