// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What is known after a frame: the camera's motion and that of every other rigid body, the points
// on them, and how the step went.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mvo/types.hpp"

namespace mvo {

/// What a step left out because its time was up.
struct CutShort {
  bool refinement = false;  ///< of proposals, which are as coarse as they were found
  bool rounds = false;      ///< of the label loop
  bool batch = false;       ///< some motions are the last window's and their newest frame pair

  bool any() const { return refinement || rounds || batch; }
  /// "refinement, batch"; empty if nothing was.
  std::string text() const {
    std::string out;
    const auto add = [&out](bool is, const char* name) {
      if (is) out.append(out.empty() ? "" : ", ").append(name);
    };
    add(refinement, "refinement");
    add(rounds, "rounds");
    add(batch, "batch");
    return out;
  }
};

/// kNew in the first frame of an id; the last two of those that have departed.
enum class MotionState { kNew, kTracked, kStopped, kLost };

/// One motion as known at a frame. The static world (id 0) is the camera's own motion.
struct MotionEstimate {
  LabelId id = kStatic;
  MotionState state = MotionState::kTracked;
  Eigen::Isometry3d T_world_motion =
      Eigen::Isometry3d::Identity();  ///< id 0: T_world_camera (III-G, geocentric)
  Eigen::Isometry3d T_ck_c1 =
      Eigen::Isometry3d::Identity();  ///< ^lT_CkC1; its inverse is the egocentric motion
  Matrix6d covariance =
      Matrix6d::Zero();  ///< of the left perturbation of T_ck_c1 (rho, phi) [m^2, m rad, rad^2]
  Eigen::Isometry3d T_ck_motion =
      Eigen::Isometry3d::Identity();  ///< egocentric pose of the motion's frame; id 0: of the world
  std::optional<Eigen::Isometry3d>
      T_ckm1_motion;  ///< the same, in the frame before; none if there was no pose then
  Matrix6d step_covariance =
      Matrix6d::Zero();  ///< of the left perturbation of T_ck_ckm1 [m^2, m rad, rad^2]
  /// Of the left perturbation of T_ck_motion [m^2, m rad, rad^2]: since the id was first seen, and
  /// for the camera what it lacks of when it was lost; it grows.
  Matrix6d pose_covariance = Matrix6d::Zero();
  double significance = 0;  ///< of the motion in the window against rest, see RestDistance
  FrameId first_frame = 0;  ///< C_1
  FrameId birth_frame = 0;  ///< of the id
  int support = 0;          ///< tracklets in the window
  int visible = 0;          ///< tracklets seen in this frame
  double rms = 0;           ///< of the batch's residuals [px]
  bool converged = false;   ///< the batch
  Eigen::Vector3d centroid_world =
      Eigen::Vector3d::Zero();  ///< of the points seen in this frame [m]
  /// The box around the points seen in this frame but the outermost twentieth on each side, which
  /// may be mislabelled; along the axes of the motion's frame [m], empty if there are none.
  Eigen::AlignedBox3d extent_motion;
};

/// An id without a pose in this frame.
struct DepartedMotion {
  LabelId id = kOutlier;
  MotionState state = MotionState::kLost;  ///< kStopped: its points are part of the static world
  Eigen::Isometry3d T_world_motion = Eigen::Isometry3d::Identity();  ///< its last
  FrameId birth_frame = 0;
  FrameId last_frame = 0;  ///< with a pose
};

/// A tracklet seen in a frame and what it was found to belong to.
struct LabeledPoint {
  TrackletId tracklet = 0;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
  LabelId id = kOutlier;
  int length = 1;  ///< observations so far
};

/// A pose that later frames have improved: the estimate of a past frame as of the last window that
/// contains it.
struct SmoothedPose {
  LabelId id = kStatic;
  FrameId frame = 0;
  Eigen::Isometry3d T_world_motion = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d T_ck_motion = Eigen::Isometry3d::Identity();  ///< id 0: T_ck_world
};

/// What addFrame knows after one frame.
struct MultimotionEstimate {
  FrameId frame = 0;
  FrameId window_begin = 0;  ///< the oldest frame of the window
  std::int64_t stamp_ns = 0;
  bool valid = false;   ///< false: no estimate of the camera, `problem` says why
  std::string problem;  ///< one sentence, empty if all is well
  /// One sentence if the camera's pose goes on in another way than before: by another label that
  /// became the static world, after having been lost, or after a correction too large to be a
  /// motion. Its newest pose goes on from the last that was said; those before it stay.
  std::string notice;
  int world_changes = 0;  ///< how often another label has become the static world so far
  /// As the motion of id 0 says; without an estimate of the camera, where it is taken to be: going
  /// on as it did for trajectory.extrapolation, then standing.
  Eigen::Isometry3d T_world_camera = Eigen::Isometry3d::Identity();
  std::vector<MotionEstimate>
      motions;  ///< those with a pose in this frame; the camera (id 0) first
  std::vector<LabeledPoint>
      points;  ///< every tracklet with at least two observations that is seen in this frame
  std::vector<DepartedMotion> departed;  ///< resting ids, and once those just lost
  std::vector<SmoothedPose> smoothed;    ///< all poses of this window
  int rounds = 0;                        ///< of the label loop
  bool converged = false;                ///< the labels settled and nothing was cut short
  CutShort cut_short;                    ///< by engine.time_budget_ms
  int unestimated = 0;                   ///< labels that had support but no pose in this frame
  std::vector<std::pair<std::string, double>>
      timings_ms;  ///< stage and wall time, in the order of the pipeline
};

}  // namespace mvo
