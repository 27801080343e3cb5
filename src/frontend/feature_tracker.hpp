// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Front end (III): salient points, matched left-right and over time, with the circle of four images
// closed.
#pragma once

#include <map>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "frontend/corner_peaks.hpp"
#include "frontend/keypoints.hpp"
#include "frontend/reference_patch.hpp"
#include "mvo/odometry.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A point seen in a frame: a link of a tracklet.
struct Feature {
  TrackletId id = 0;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< (u_l, v, u_r) [px]
};

/// What is expected of the next frame: where known points will be, and where more points are
/// wanted.
struct TrackingPrior {
  std::map<TrackletId, Eigen::Vector3d>
      predicted;  ///< y in the next frame; points without one start where they are
  std::map<TrackletId, bool>
      dense;  ///< points of moving bodies: their surroundings get more points
};

/// Image pyramids (or keypoints) of one frame, as the trackers need them.
struct FrameImages {
  std::vector<cv::Mat> left;      ///< pyramid; the descriptor tracker needs the image only
  std::vector<cv::Mat> right;     ///< the same; empty for RGB-D
  cv::Mat depth;                  ///< RGB-D [m]
  std::vector<CornerPeak> peaks;  ///< of the left image
  KeypointSet left_points;        ///< descriptor tracker only
  KeypointSet right_points;       ///< the same
};

/// What of the front end depends on a frame's images alone.
FrameImages prepareImages(const Frame& frame, const FrontendOptions& options);

/// Follows points from frame to frame. Owns the last images and the points seen in them, nothing
/// else.
class FeatureTracker {
 public:
  FeatureTracker(const StereoCamera& camera, const FrontendOptions& options, int max_gap);

  /// The points seen in this frame, in increasing order of id: those found again keep their id, new
  /// ones have fresh ids. The images are those of prepareImages(). Deterministic.
  std::vector<Feature> track(FrameImages images, const TrackingPrior& prior);
  std::vector<Feature> track(const Frame& frame, const TrackingPrior& prior) {
    return track(prepareImages(frame, options_), prior);
  }

  /// Tracker, patch and pyramid must stay as they were. If fewer features are wanted than before,
  /// the surplus is no longer followed.
  void setOptions(const FrontendOptions& options);

 private:
  // The patch a point was born with, and where it was last seen.
  struct Appearance {
    TrackletId id = 0;
    std::shared_ptr<const ReferencePatch> patch;
    PatchWarp left;
    PatchWarp right;
  };

  void forgetSurplus(const TrackingPrior& prior);
  std::vector<Feature> found(const FrameImages& images, const TrackingPrior& prior);
  std::vector<Feature> detect(const FrameImages& images, const std::vector<Feature>& known,
                              const TrackingPrior& prior);
  // A point's appearance in new images, which also says where exactly it is.
  struct Alignment {
    std::optional<Appearance> appearance;  // none if there is too little texture
    bool matches = true;                   // false: the eyes see different things there
  };
  Alignment aligned(const FrameImages& images, const Feature& feature) const;
  const Appearance* appearanceOf(TrackletId id) const;
  void alignWithReferences(const FrameImages& images, std::vector<Feature>& features);

  StereoCamera camera_;
  FrontendOptions options_;
  int max_gap_;
  std::vector<FrameImages> past_;  // newest last, at most 1 + max_gap
  std::vector<std::vector<Feature>>
      waiting_;  // per past frame: points last seen there, not yet found again
  std::vector<Appearance> appearances_;  // by id
  TrackletId next_id_ = 0;
  bool surplus_ = false;  // may be followed: fewer are wanted than were
};

}  // namespace mvo
