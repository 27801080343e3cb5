// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Front end (III): salient points, matched left-right and over time, with the circle of four images
// closed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "frontend/features.hpp"
#include "frontend/reference_patch.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Follows points from frame to frame. Owns the last images and the points seen in them, nothing
/// else.
class FeatureTracker {
 public:
  explicit FeatureTracker(int max_gap) : max_gap_(max_gap) {}

  /// The points seen in this frame, in increasing order of id: those found again keep their id, new
  /// ones have fresh ids. The images are those of prepareFrame(). Tracker, patch and pyramid must
  /// stay as they were; if fewer features are wanted than in the frame before, the surplus is no
  /// longer followed. Deterministic.
  std::vector<Feature> track(FrameImages images, const TrackingPrior& prior,
                             const StereoCamera& camera, const FrontendOptions& options);

 private:
  // The patch a point was born with, and where it was last seen.
  struct Appearance {
    TrackletId id = 0;
    std::shared_ptr<const ReferencePatch> patch;
    PatchWarp left;
    PatchWarp right;
  };

  void forgetSurplus(const TrackingPrior& prior, int max_features);
  std::vector<Feature> found(const FrameImages& images, const TrackingPrior& prior,
                             const StereoCamera& camera, const FrontendOptions& options);
  std::vector<Feature> detect(const FrameImages& images, const std::vector<Feature>& known,
                              const TrackingPrior& prior, const StereoCamera& camera,
                              const FrontendOptions& options);
  // A point's appearance in new images, which also says where exactly it is.
  struct Alignment {
    std::optional<Appearance> appearance;  // none if there is too little texture
    bool matches = true;                   // false: the eyes see different things there
  };
  Alignment aligned(const FrameImages& images, const Feature& feature, int patch_side) const;
  const Appearance* appearanceOf(TrackletId id) const;
  void alignWithReferences(const FrameImages& images, const TrackingPrior& prior, int patch_side,
                           std::vector<Feature>& features);

  int max_gap_;
  std::vector<FrameImages> past_;  // newest last, at most 1 + max_gap
  std::vector<std::vector<Feature>>
      waiting_;  // per past frame: points last seen there, not yet found again
  std::vector<Appearance> appearances_;  // by id
  TrackletId next_id_ = 0;
  int wanted_ = 0;  // features, in the last frame
};

}  // namespace mvo
