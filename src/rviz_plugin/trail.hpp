// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The part of a motion's trajectory that is drawn.
#pragma once

#include <geometry_msgs/PoseStamped.h>

#include <Eigen/Core>
#include <vector>

namespace mvo_rviz {

constexpr int kLongestTrail = 10000;  ///< [poses]; one line of billboards holds some 16000

/// Positions of the newest `length` poses, oldest first; 0 takes all, up to kLongestTrail.
std::vector<Eigen::Vector3d> cutTrail(const std::vector<geometry_msgs::PoseStamped>& trajectory,
                                      int length);

}  // namespace mvo_rviz
