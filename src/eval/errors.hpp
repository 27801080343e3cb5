// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How far an aligned trajectory is from the true one: per frame, between consecutive frames, at the
// end. Translations in m, rotations in rad.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "eval/frames.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

/// A P_k B, and the id of the motion it was estimated as (0 for the camera).
struct AlignedPose {
  int id = 0;
  Eigen::Isometry3d T_world_body = Eigen::Isometry3d::Identity();
};

/// An aligned pose for each frame that has an estimate.
using AlignedTrack = std::vector<std::optional<AlignedPose>>;

/// (roll, pitch, yaw) of R = Rz(yaw) Ry(pitch) Rx(roll) [rad].
Eigen::Vector3d rollPitchYaw(const Eigen::Matrix3d& R);

/// E_k = G_k^-1 A P_k B, in the camera's optical axes.
std::vector<PoseError> cameraErrors(const AlignedTrack& track, const FramePoses& truth);

/// Translation A P_k B - G_k and rotation (A P_k B)_R G_k,R^T, in the axes of the true world.
std::vector<PoseError> bodyErrors(const AlignedTrack& track, const FramePoses& truth);

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

StepSummary summarize(const std::vector<StepError>& errors);

/// Estimated over true path length, both over the frames that have both poses; none for a true path
/// without length.
std::optional<double> pathScale(const AlignedTrack& track, const FramePoses& truth);

/// None if fewer than two frames have both poses. Needs no alignment.
std::optional<EndDrift> endDrift(const FramePoses& estimate, const FramePoses& truth);

}  // namespace mvo
