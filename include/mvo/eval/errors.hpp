// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far an aligned trajectory is from the true one: per frame, between consecutive frames, at the
// end. Translations in m, rotations in rad.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "mvo/eval/frames.hpp"

namespace mvo {

/// A P_k B, and the id of the motion it was estimated as (0 for the camera).
struct AlignedPose {
  int id = 0;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// An aligned pose for each frame that has an estimate.
using AlignedTrack = std::vector<std::optional<AlignedPose>>;

/// The error of one frame.
struct PoseError {
  std::size_t frame = 0;
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();     ///< [m]
  Eigen::Vector3d roll_pitch_yaw = Eigen::Vector3d::Zero();  ///< about x, y, z [rad]
  double angle = 0;                                          ///< total [rad]
  int id = 0;                                                ///< the motion that gave the pose
};

/// (roll, pitch, yaw) of R = Rz(yaw) Ry(pitch) Rx(roll) [rad].
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& R);

/// E_k = G_k^-1 A P_k B, in the camera's optical axes.
std::vector<PoseError> cameraErrors(const AlignedTrack& track, const FramePoses& truth);

/// Translation A P_k B - G_k and rotation (A P_k B)_R G_k,R^T, in the axes of the true world.
std::vector<PoseError> bodyErrors(const AlignedTrack& track, const FramePoses& truth);

/// Maxima and means of errors.
struct ErrorSummary {
  int frames = 0;
  double max = 0;             ///< of the translation's norm [m]
  double rmse = 0;            ///< [m]; over all frames this is the ATE
  double max_percent = 0;     ///< of the path; 0 for a path without length
  double rmse_percent = 0;    ///< of the path
  std::size_t max_frame = 0;  ///< the frame of max
  Eigen::Vector3d signed_max = Eigen::Vector3d::Zero();      ///< largest by magnitude, per axis [m]
  Eigen::Vector3d signed_max_rpy = Eigen::Vector3d::Zero();  ///< likewise [rad]
  Eigen::Vector3d rmse_rpy = Eigen::Vector3d::Zero();        ///< [rad]
  double max_angle = 0;                                      ///< [rad]
  double rmse_angle = 0;                                     ///< [rad]
};

/// All zero for no errors.
ErrorSummary summarize(const std::vector<PoseError>& errors, double path_length);

/// The errors of the frames for which keep is true.
std::vector<PoseError> restrictTo(const std::vector<PoseError>& errors,
                                  const std::vector<bool>& keep);

/// The error of the step from a frame to the next.
struct StepError {
  std::size_t frame = 0;   ///< the later one
  double translation = 0;  ///< [m]
  double angle = 0;        ///< [rad]
};

/// (G_k^-1 G_k+1)^-1 (P_k^-1 P_k+1) over consecutive frames; no step across a frame without
/// estimate.
std::vector<StepError> cameraStepErrors(const AlignedTrack& track, const FramePoses& truth);

/// The difference of the displacements of the body's centre in the world, and the angle between the
/// rotations of the step; no step across a frame without estimate or a change of id.
std::vector<StepError> bodyStepErrors(const AlignedTrack& track, const FramePoses& truth);

/// Root mean squares and maxima of step errors; all zero for none.
struct StepSummary {
  int steps = 0;
  double rmse = 0;        ///< [m]
  double max = 0;         ///< [m]
  double rmse_angle = 0;  ///< [rad]
  double max_angle = 0;   ///< [rad]
};
StepSummary summarize(const std::vector<StepError>& errors);

/// The error of the last common pose when both trajectories start at their first common pose.
struct EndDrift {
  std::size_t first_frame = 0;
  std::size_t last_frame = 0;
  double path = 0;             ///< of the truth between them [m]
  double translation = 0;      ///< [m]
  double percent = 0;          ///< of the path; 0 for a path without length
  double angle = 0;            ///< [rad]
  double angle_per_metre = 0;  ///< [rad/m]; 0 for a path without length
};

/// None if fewer than two frames have both poses. Needs no alignment.
std::optional<EndDrift> endDrift(const FramePoses& estimate, const FramePoses& truth);

}  // namespace mvo
