// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/geocentric.hpp"

#include <algorithm>

#include "mvo/se3.hpp"

namespace mvo {

void GeocentricTrajectories::update(LabelId id, const Trajectory& trajectory,
                                    const Eigen::Vector3d& centroid_c1) {
  if (trajectory.empty()) return;
  const FrameId first =
      id == kStatic ? std::max(trajectory.first_frame, since_) : trajectory.first_frame;
  if (first > trajectory.lastFrame()) return;
  auto& poses = T_ck_l_[id];
  // The anchor is the oldest frame that is known already; later ones are estimated anew.
  FrameId anchor = first;
  Eigen::Isometry3d T_ca_l = Eigen::Isometry3d::Identity();
  const auto known = poses.lower_bound(first);
  if (known != poses.end() && known->first <= trajectory.lastFrame()) {
    anchor = known->first;
    T_ca_l = known->second;
  } else if (!poses.empty()) {  // lost or at rest in between: goes on from where it was
    const auto T_ca_world = inCamera(kStatic, anchor);
    const auto rested = T_world_l_.find(id);
    T_ca_l = id != kStatic && T_ca_world && rested != T_world_l_.end()
                 ? *T_ca_world * rested->second
                 : poses.rbegin()->second;
  } else if (id != kStatic) {
    T_ca_l.translation() = centroid_c1;
  }
  for (FrameId k = first; k <= trajectory.lastFrame(); ++k)
    if (const auto T_ck_ca = trajectory.between(k, anchor)) poses[k] = *T_ck_ca * T_ca_l;
  if (const auto T = inWorld(id, trajectory.lastFrame())) T_world_l_[id] = *T;
}

void GeocentricTrajectories::continueFrom(FrameId frame, const Eigen::Isometry3d& T_world_ck) {
  auto& poses = T_ck_l_[kStatic];
  poses.erase(poses.lower_bound(frame), poses.end());
  poses[frame] = T_world_ck.inverse();
  since_ = frame;
}

bool GeocentricTrajectories::bridges(const Trajectory& trajectory) const {
  const auto poses = T_ck_l_.find(kStatic);
  if (poses == T_ck_l_.end() || trajectory.empty()) return false;
  const auto known = poses->second.lower_bound(std::max(trajectory.first_frame, since_));
  return known != poses->second.end() && known->first <= trajectory.lastFrame();
}

Vector6d GeocentricTrajectories::contradiction(const Trajectory& trajectory, FrameId frame) const {
  const auto poses = T_ck_l_.find(kStatic);
  const auto T_ck_world = inCamera(kStatic, frame);
  if (poses == T_ck_l_.end() || trajectory.empty() || !T_ck_world) return Vector6d::Zero();
  const auto first = poses->second.lower_bound(std::max(trajectory.first_frame, since_));
  if (first == poses->second.end() || first->first >= frame) return Vector6d::Zero();
  const auto T_ck_first = trajectory.between(frame, first->first);
  return T_ck_first ? log(*T_ck_first * first->second * T_ck_world->inverse())
                    : Vector6d(Vector6d::Zero());
}

bool GeocentricTrajectories::knows(LabelId id) const {
  const auto poses = T_ck_l_.find(id);
  return poses != T_ck_l_.end() && !poses->second.empty();
}

std::optional<Eigen::Isometry3d> GeocentricTrajectories::inCamera(LabelId id, FrameId frame) const {
  const auto poses = T_ck_l_.find(id);
  if (poses == T_ck_l_.end()) return std::nullopt;
  const auto it = poses->second.find(frame);
  if (it == poses->second.end()) return std::nullopt;
  return it->second;
}

std::optional<Eigen::Isometry3d> GeocentricTrajectories::inWorld(LabelId id, FrameId frame) const {
  const auto T_ck_world = inCamera(kStatic, frame);
  const auto T_ck_l = inCamera(id, frame);
  if (!T_ck_world || !T_ck_l) return std::nullopt;
  if (id == kStatic) return T_ck_world->inverse();
  return T_ck_world->inverse() * *T_ck_l;
}

std::vector<SmoothedPose> GeocentricTrajectories::since(FrameId first_frame) const {
  std::vector<SmoothedPose> all;
  const auto world = T_ck_l_.find(kStatic);
  if (world == T_ck_l_.end()) return all;
  for (const auto& [id, poses] : T_ck_l_) {
    auto T_ck_world = world->second.lower_bound(first_frame);
    for (auto it = poses.lower_bound(first_frame); it != poses.end(); ++it) {
      while (T_ck_world != world->second.end() && T_ck_world->first < it->first) ++T_ck_world;
      if (T_ck_world == world->second.end()) break;
      if (T_ck_world->first != it->first) continue;
      const Eigen::Isometry3d T_world_ck = T_ck_world->second.inverse();
      all.push_back(
          {id, it->first, id == kStatic ? T_world_ck : T_world_ck * it->second, it->second});
    }
  }
  return all;
}

void GeocentricTrajectories::forgetBefore(FrameId frame) {
  for (auto& [id, poses] : T_ck_l_)
    while (poses.size() > 1 && poses.begin()->first < frame) poses.erase(poses.begin());
}

void GeocentricTrajectories::forgetBodies(FrameId frame, const std::set<LabelId>& known) {
  for (auto it = T_ck_l_.begin(); it != T_ck_l_.end();) {
    const auto& [id, poses] = *it;
    const bool kept =
        id == kStatic || known.count(id) != 0 || (!poses.empty() && poses.rbegin()->first >= frame);
    if (!kept) T_world_l_.erase(id);
    it = kept ? std::next(it) : T_ck_l_.erase(it);
  }
}

}  // namespace mvo
