// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What moves near a point: the planner's question.
#pragma once

#include <mvo/MotionArray.h>
#include <mvo/MovingObject.h>

#include <Eigen/Core>
#include <vector>

namespace mvo_ros {

/// The bodies with a pose now that differ significantly from rest and whose box is within `radius`
/// [m] of a point in header.frame_id (0: all), nearest first.
std::vector<mvo::MovingObject> movingObjects(const mvo::MotionArray& motions,
                                             const Eigen::Vector3d& center, double radius);

}  // namespace mvo_ros
