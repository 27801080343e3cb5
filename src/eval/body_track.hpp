// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One trajectory per true body out of the ids that were found on it.
#pragma once

#include <map>
#include <vector>

#include "eval/errors.hpp"
#include "eval/frames.hpp"
#include "eval/masked_points.hpp"

namespace mvo {

/// Trajectories T_world_motion by id.
using MotionPoses = std::map<int, FramePoses>;

/// Tracklets of each id in each frame.
using Supports = std::vector<std::map<int, int>>;

/// The aligned poses of a body and how often more than one id had one.
struct BodyTrack {
  AlignedTrack poses;
  std::vector<int> ids;      ///< that gave a pose in some frame or could have, increasing
  int duplicate_frames = 0;  ///< frames with a pose of more than one id
};

/// Each id is aligned by its own first poses (its body frame is its own). In a frame with several
/// the one with most tracklets gives the pose, on a tie the lower id.
BodyTrack trackBody(int body, const MotionPoses& motions, const Association& association,
                    const FramePoses& truth, const Eigen::Isometry3d& A, const Supports& supports);

/// For truth without masks: each id belongs to the body whose trajectory its own fits best over all
/// of their common frames (at least 3). Id 0 is the static world.
Association associateByMotion(const MotionPoses& motions, const std::map<int, FramePoses>& bodies,
                              const Eigen::Isometry3d& A);

}  // namespace mvo
