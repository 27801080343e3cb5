// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The transforms between the frames of an estimate and those of the truth, from the estimate's
// first poses ("the first 25 frames of the estimates are used to calibrate this transform").
#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "eval/frames.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

/// Poses that calibrate an alignment.
constexpr int kAlignmentPoses = 25;

/// The camera's frame is the true one and only the world is free: G_k ~ A P_k. A minimizes
/// sum |A_R P_R - G_R|_F^2 + |A P_t - G_t|^2 over the first poses that have a true one (1 rad and
/// 1 m weigh alike). None if there is no such pose.
std::optional<Alignment> alignLeft(const FramePoses& estimate, const FramePoses& truth,
                                   int poses = kAlignmentPoses);

/// For estimates of another camera-fixed frame: G_k ~ A P_k B. B's rotation starts from the
/// relative motions (hand-eye), then both rotations alternate; the translations follow, with a weak
/// ridge on the lever arm, which is unobservable without rotation.
std::optional<Alignment> alignLeftRight(const FramePoses& estimate, const FramePoses& truth,
                                        int poses = kAlignmentPoses);

/// A body: the world is the camera's, the body frame is free: G_k ~ A P_k B with A given.
std::optional<Alignment> alignBody(const FramePoses& estimate, const FramePoses& truth,
                                   const Eigen::Isometry3d& A, int poses = kAlignmentPoses);

/// Root mean square over the calibrating poses of the misfit, 1 rad and 1 m weighed alike. Law:
/// zero for an estimate that is the truth up to the alignment.
double misfit(const Alignment& alignment, const FramePoses& estimate, const FramePoses& truth,
              int poses = kAlignmentPoses);

}  // namespace mvo
