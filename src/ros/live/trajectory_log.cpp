// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ros/live/trajectory_log.hpp"

#include <filesystem>
#include <stdexcept>

namespace mvo_ros {

void TrajectoryLog::add(const Step& step) {
  if (step.restarted) poses_.clear();
  const std::int64_t now = step.estimate.stamp_ns;
  if (step.estimate.valid)
    for (const mvo::MotionEstimate& m : step.estimate.motions)
      poses_[m.id].push_back(
          {now, m.T_world_motion.translation(), Eigen::Quaterniond(m.T_world_motion.linear())});
  const auto oldest = now - static_cast<std::int64_t>(1e9 * history_);
  for (auto it = poses_.begin(); it != poses_.end();) {
    while (!it->second.empty() && it->second.front().stamp_ns < oldest) it->second.pop_front();
    it = it->second.empty() ? poses_.erase(it) : std::next(it);
  }
}

std::vector<std::string> TrajectoryLog::save(const std::string& folder) const {
  const std::filesystem::path path(folder);
  if (!path.is_absolute())
    throw std::runtime_error("folder '" + folder + "' is no absolute path on the node's machine");
  if (poses_.empty()) throw std::runtime_error("there are no poses yet");
  std::map<std::filesystem::path, std::vector<mvo::StampedPose>> files;
  for (const auto& [id, poses] : poses_) {
    const std::string name =
        id == mvo::kStatic ? "camera.tum" : "motion_" + std::to_string(id) + ".tum";
    std::vector<mvo::StampedPose>& file = files[path / name];
    for (const Pose& pose : poses) {
      mvo::StampedPose& out = file.emplace_back();
      out.stamp_ns = pose.stamp_ns;
      out.T_world_body = Eigen::Translation3d(pose.translation) * pose.rotation;
    }
  }
  for (const auto& file : files)
    if (std::filesystem::exists(file.first))
      throw std::runtime_error(file.first.string() + " exists and is not overwritten");
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) throw std::runtime_error(folder + " cannot be made: " + error.message());
  std::vector<std::string> written;
  try {
    for (const auto& [file, poses] : files) {
      mvo::writeTum(file, poses);
      written.push_back(file.string());
    }
  } catch (const std::exception& problem) {
    for (const std::string& file : written) std::filesystem::remove(file, error);
    throw std::runtime_error(problem.what());
  }
  return written;
}

}  // namespace mvo_ros
