// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Where the points of the last frame will be in the next one: each moves on with its motion.
#pragma once

#include <optional>
#include <vector>

#include "frontend/features.hpp"
#include "frontend/tracklet_window.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/tracklet_map.hpp"

namespace mvo {

/// What is known of a label's motion when the next frame comes.
struct LabelStep {
  std::optional<Eigen::Isometry3d> T_next_last;  ///< at constant velocity; none if it is unknown
  bool is_body = false;                          ///< a body's motion, not the static world's
};

/// Which step each tracklet of the window follows: an index into the steps; outliers have none.
struct KnownMotions {
  std::vector<LabelStep> steps;
  TrackletMap<int> step_of;
};

/// Points move on with their label, outliers as they last moved in the image, and points that are
/// not in the window yet like the nearest one that is. Points of bodies, and outliers, which may be
/// bodies of their own, want as dense surroundings as a known one.
TrackingPrior predictFeatures(const std::vector<Feature>& seen, const TrackletWindow& window,
                              const KnownMotions& motions, const StereoCamera& camera,
                              double min_disparity);

}  // namespace mvo
