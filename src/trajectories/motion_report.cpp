// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "trajectories/motion_report.hpp"

#include <algorithm>
#include <array>

#include "statistics.hpp"
#include "trajectories/uncertainty.hpp"

namespace mvo {

namespace {

constexpr std::size_t kTrimmedShare = 20;  // one point in so many, on each side, may be mislabelled

}  // namespace

void reportPoints(const std::vector<LabeledPoint>& points, const StereoCamera& camera,
                  double min_disparity, MotionEstimate& motion) {
  const Eigen::Isometry3d T_motion_ck = motion.T_ck_motion.inverse();
  const Eigen::Isometry3d T_world_ck =
      motion.id == kStatic ? motion.T_world_motion : motion.T_world_motion * T_motion_ck;
  Eigen::Vector3d sum_ck = Eigen::Vector3d::Zero();
  std::array<std::vector<double>, 3> along;  // x, y, z of the motion's frame
  for (const LabeledPoint& p : points) {
    if (p.id != motion.id) continue;
    ++motion.visible;
    if (p.y.x() - p.y.z() <= min_disparity) continue;
    const Eigen::Vector3d p_ck = camera.backProject(p.y);
    sum_ck += p_ck;
    const Eigen::Vector3d p_motion = T_motion_ck * p_ck;
    for (int axis = 0; axis < 3; ++axis) along[axis].push_back(p_motion[axis]);
  }
  const std::size_t near = along[0].size();
  if (near == 0) return;
  motion.centroid_world = T_world_ck * (sum_ck / static_cast<double>(near));
  const std::size_t trimmed = near / kTrimmedShare;
  for (int axis = 0; axis < 3; ++axis) {
    motion.extent_motion.min()[axis] = valueOfRank(along[axis], trimmed);
    motion.extent_motion.max()[axis] = valueOfRank(along[axis], near - 1 - trimmed);
  }
}

double significanceOf(const MotionEstimate& motion, FrameId now, const Matrix6d& of_camera,
                      const std::vector<SmoothedPose>& poses) {
  const bool is_world = motion.id == kStatic;
  const Matrix6d covariance =
      stepCovariance(is_world ? Eigen::Isometry3d::Identity() : motion.T_ck_motion,
                     is_world ? motion.covariance : Matrix6d(motion.covariance + of_camera));
  const RestDistance from_first(covariance);
  const RestDistance from_later(2 * covariance);
  double significance = 0;
  for (const SmoothedPose& past : poses)
    if (past.id == motion.id && past.frame < now)
      significance =
          std::max(significance, (past.frame == motion.first_frame ? from_first : from_later)(
                                     past.T_world_motion.inverse() * motion.T_world_motion));
  return significance;
}

}  // namespace mvo
