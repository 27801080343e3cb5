// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-G: from a window's motions to trajectories in the world that go on from window to window.
#pragma once

#include <vector>

#include "mvo/estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/segment_motions.hpp"
#include "mvo/stereo_camera.hpp"
#include "trajectories/geocentric.hpp"
#include "trajectories/label_continuity.hpp"
#include "trajectories/motion_lifetimes.hpp"

namespace mvo {

/// Remembers which motion is which, where each has been, and since when it is known.
class MotionTrajectories {
 public:
  /// A tracklet that goes on under another name.
  void rename(TrackletId from, TrackletId to) { continuity_.rename(from, to); }

  /// Gives every label its id; exactly one is the static world, unless there are no labels.
  Labeling identify(const Window& window, const Segmentation& segmentation,
                    const TrajectoryOptions& options);

  /// Continues the trajectories of a window's motions, whose labels have ids, to its newest frame.
  /// The world is the camera of frame 0, which has a pose if `min_tracklets` points are seen there.
  MultimotionEstimate add(const Window& window, const Segmentation& segmentation,
                          const std::vector<SeenTracklet>& seen, int points_seen,
                          const StereoCamera& camera, const Options& options);

 private:
  void place(const Segmentation& segmentation);

  LabelContinuity continuity_;
  GeocentricTrajectories geocentric_;
  MotionLifetimes lifetimes_;
};

}  // namespace mvo
