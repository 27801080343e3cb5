// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The window as an exact camera would have seen it: what the camera does otherwise is found out
// from the measurements and taken out of them.
#pragma once

#include <optional>
#include <vector>

#include "frontend/camera/camera_errors.hpp"
#include "frontend/camera/error_influence.hpp"
#include "frontend/camera/rolling_shutter.hpp"
#include "mvo/options.hpp"

namespace mvo {

/// Owns what is known of the camera, and the corrected window.
class CameraModel {
 public:
  explicit CameraModel(const StereoCamera& camera) : errors_(camera) {}

  void addFrame(FrameId frame, double time, bool sensed_depth, const Options& options);
  /// Goes on from what was known of the pair's error before.
  void startFrom(const ErrorEstimate& known) { errors_.startFrom(known); }
  /// Of the pair's error; none if the pair is trusted.
  std::optional<ErrorEstimate> errors(const Options& options) const;
  /// Corrects the window as it was seen, which must outlive what measured() gives.
  void correct(const Window& seen, const StereoCamera& camera, const Options& options);
  /// As an exact pair would have seen it, and with a global shutter besides.
  const Window& paired() const { return paired_ ? *paired_ : *seen_; }
  const Window& measured() const { return measured_ ? *measured_ : paired(); }
  /// What the rows of the newest frame's points say, which the window must hold already.
  void learnRows(const std::vector<Feature>& features, const TrackletWindow& window,
                 const Options& options);
  /// What the newest frame's tracklets of a label say that is thought to rest.
  void learnMotion(const Trajectory& world, const std::vector<int>& support,
                   const StereoCamera& camera, const Options& options);
  /// Adds what the pair's error, as far as it is not known, makes of the motions to their
  /// covariances.
  void addUncertainty(Segmentation& segmentation, const StereoCamera& camera,
                      const Options& options);

 private:
  bool isTrusted(const Options& options) const;

  CameraErrors errors_;
  ErrorInfluence influence_;
  RollingShutter shutter_;
  bool sensed_depth_ = false;
  const Window* seen_ = nullptr;
  std::optional<Window> paired_;    // as an exact pair would have seen it
  std::optional<Window> measured_;  // and with a global shutter
};

}  // namespace mvo
