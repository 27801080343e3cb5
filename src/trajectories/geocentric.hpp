// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-G: from each label's egomotion hypothesis to poses in the world, continued beyond the window.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "mvo/estimate.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Remembers the pose of every motion's frame in the camera, T_ck_l, for the frames of the window.
/// A pose is frozen as it was smoothed when its frame left the window; the label's batch continues
/// from there, so that trajectories are anchored once per window and not chained from newest-frame
/// steps. The world is the camera of the first frame.
class GeocentricTrajectories {
 public:
  /// Takes a label's batch estimate. The body frame is fixed when an id is first seen: axes of the
  /// camera in its first frame, origin at `centroid_c1` (III-G); for the static world it is the
  /// world itself.
  void update(LabelId id, const Trajectory& trajectory, const Eigen::Vector3d& centroid_c1);

  /// From here on the camera goes on from this pose of its in `frame`, whichever motion is the
  /// static world's: poses before it are not estimated anew, those after it are forgotten.
  void continueFrom(FrameId frame, const Eigen::Isometry3d& T_world_ck);

  /// Whether a trajectory of the static world has a frame in which the camera is known.
  bool bridges(const Trajectory& trajectory) const;

  /// By how much a trajectory of the static world moves otherwise than the camera did between the
  /// first frame that both know and this one, in the camera of this: a left perturbation of
  /// T_ck_world. Zero where they share no frames.
  Vector6d contradiction(const Trajectory& trajectory, FrameId frame) const;

  /// Whether an id has a pose, so that its body frame is fixed.
  bool knows(LabelId id) const;
  /// T_ck_l; for the static world T_ck_world.
  std::optional<Eigen::Isometry3d> inCamera(LabelId id, FrameId frame) const;
  /// T_world_motion(k); for the static world the camera's T_world_ck.
  std::optional<Eigen::Isometry3d> inWorld(LabelId id, FrameId frame) const;
  /// All poses in the world from `first_frame` on.
  std::vector<SmoothedPose> since(FrameId first_frame) const;
  /// Frames before this one are no longer needed (the newest pose of each id is kept, to start
  /// again from).
  void forgetBefore(FrameId frame);
  /// Bodies without a pose from this frame on, other than these, never come back.
  void forgetBodies(FrameId frame, const std::set<LabelId>& known);

 private:
  std::map<LabelId, std::map<FrameId, Eigen::Isometry3d>> T_ck_l_;
  std::map<LabelId, Eigen::Isometry3d> T_world_l_;  // newest
  FrameId since_ = 0;  // the camera's poses before this frame stay as they are
};

}  // namespace mvo
