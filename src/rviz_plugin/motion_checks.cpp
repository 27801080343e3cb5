// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "rviz_plugin/motion_checks.hpp"

#include <cmath>
#include <sstream>

namespace mvo_rviz {

namespace {

// What is wrong with a field, or nothing.
std::string problemOf(double value) {
  if (!std::isfinite(value)) return "is not finite";
  std::ostringstream text;
  if (std::abs(value) > kFarthest) text << "is " << value << ", too large to draw";
  return text.str();
}

template <typename Vector>
std::string problemOfVector(const Vector& v) {
  for (const double value : {v.x, v.y, v.z})
    if (std::string problem = problemOf(value); !problem.empty()) return problem;
  return {};
}

std::string problemOfQuaternion(const geometry_msgs::Quaternion& q) {
  constexpr double kTolerance = 0.01;
  const double norm = std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
  if (!std::isfinite(norm)) return "is not finite";
  std::ostringstream text;
  text.precision(3);
  if (std::abs(norm - 1) > kTolerance) text << "is no unit quaternion: its norm is " << norm;
  return text.str();
}

std::string problemOfExtent(const geometry_msgs::Vector3& v) {
  if (v.x < 0 || v.y < 0 || v.z < 0) return "has a negative side";
  return problemOfVector(v);
}

std::string problemOfCovariance(const mvo::Motion::_pose_type::_covariance_type& covariance) {
  for (const double value : covariance)
    if (!std::isfinite(value)) return "is not finite";
  return {};
}

std::string sentence(int id, const std::string& field, const std::string& problem) {
  return "Motion " + std::to_string(id) + ": " + field + " " + problem + "; it is not drawn.";
}

std::string problemOfTrail(const mvo::Motion& motion, const std::string& frame_id) {
  for (std::size_t i = 0; i < motion.trajectory.size(); ++i) {
    const geometry_msgs::PoseStamped& pose = motion.trajectory[i];
    const std::string field = "trajectory[" + std::to_string(i) + "]";
    if (!pose.header.frame_id.empty() && pose.header.frame_id != frame_id)
      return sentence(motion.id, field + ".header.frame_id",
                      "is '" + pose.header.frame_id + "', not '" + frame_id + "'");
    if (const std::string problem = problemOfVector(pose.pose.position); !problem.empty())
      return sentence(motion.id, field + ".pose.position", problem);
  }
  return {};
}

}  // namespace

std::string problemOf(const mvo::MotionArray& array) {
  if (array.header.frame_id.empty()) return "header.frame_id is empty; nothing is drawn.";
  return {};
}

std::string problemOf(const mvo::Motion& motion, const std::string& frame_id) {
  const int id = motion.id;
  if (id < 0) return sentence(id, "id", "is negative");
  if (motion.state > mvo::Motion::OCCLUDED)
    return sentence(id, "state", "is " + std::to_string(motion.state) + ", which means nothing");
  const auto& [field, problem] = [&]() -> std::pair<const char*, std::string> {
    if (auto p = problemOfVector(motion.pose.pose.position); !p.empty())
      return {"pose.pose.position", p};
    if (auto p = problemOfQuaternion(motion.pose.pose.orientation); !p.empty())
      return {"pose.pose.orientation", p};
    if (auto p = problemOfCovariance(motion.pose.covariance); !p.empty())
      return {"pose.covariance", p};
    if (auto p = problemOfVector(motion.twist.twist.linear); !p.empty())
      return {"twist.twist.linear", p};
    if (auto p = problemOfVector(motion.extent_center); !p.empty()) return {"extent_center", p};
    return {"extent", problemOfExtent(motion.extent)};
  }();
  if (!problem.empty()) return sentence(id, field, problem);
  return problemOfTrail(motion, frame_id);
}

}  // namespace mvo_rviz
