// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-G: from a window's motions to trajectories in the world that go on from window to window.
#pragma once

#include <map>
#include <vector>

#include "mvo/estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/segment_motions.hpp"
#include "mvo/stereo_camera.hpp"
#include "trajectories/camera_track.hpp"
#include "trajectories/geocentric.hpp"
#include "trajectories/growing_covariance.hpp"
#include "trajectories/label_continuity.hpp"
#include "trajectories/motion_lifetimes.hpp"
#include "trajectories/static_world.hpp"

namespace mvo {

/// Remembers which motion is which, where each has been, and since when it is known.
class MotionTrajectories {
 public:
  /// A tracklet that goes on under another name.
  void rename(TrackletId from, TrackletId to) { continuity_.rename(from, to); }

  /// T_world_camera as the newest estimate said it.
  const Eigen::Isometry3d& newestPose() const { return camera_.newest(); }

  /// Gives every label its id; one is the static world, unless it is out of sight.
  Labeling identify(const Window& window, const Segmentation& segmentation,
                    const StereoCamera& camera, const Options& options);

  /// Continues the trajectories of a window's motions, whose labels have ids, to its newest frame.
  /// The world is the camera of frame 0, which has a pose if `min_tracklets` points are seen there.
  /// Without enough evidence, or with a step that cannot be, the camera is lost in this frame: the
  /// estimate is not valid and says why.
  MultimotionEstimate add(const Window& window, const Segmentation& segmentation,
                          const std::vector<SeenTracklet>& seen, int points_seen,
                          std::int64_t stamp_ns, const StereoCamera& camera,
                          const Options& options);

 private:
  void start(std::int64_t stamp_ns, MultimotionEstimate& estimate);
  void placeCamera(const Segmentation& segmentation, int points_seen, const Options& options,
                   MultimotionEstimate& estimate);
  void placeBodies(const Segmentation& segmentation);
  void growCovariances(const Segmentation& segmentation, FrameId now);

  LabelContinuity continuity_;
  StaticWorld world_;
  bool world_is_new_ = false;  // the label that is the world has not told a pose yet
  CameraTrack camera_;
  GeocentricTrajectories geocentric_;
  std::map<LabelId, GrowingCovariance> covariances_;  // of those with a pose
  MotionLifetimes lifetimes_;
};

}  // namespace mvo
