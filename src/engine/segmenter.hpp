// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The engine's memory: what one window's labels tell the next one.
#pragma once

#include <memory>
#include <vector>

#include "engine/batch/bundle_adjustment.hpp"
#include "mvo/deadline.hpp"
#include "mvo/options.hpp"
#include "mvo/segment_motions.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/tracklet_map.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Remembers the last window's labels, each with its landmarks, the tracklets that they hold, and
/// how well these fit.
class Segmenter {
 public:
  /// Carries the labels on to the window's newest frame, by thresholds as wide as the last window's
  /// residuals ask for. Returns the tracklets whose newest link is bad under every label: it is a
  /// wrong match or the start of a motion, so they should end before it.
  std::vector<TrackletId> extend(const Window& window, const StereoCamera& camera,
                                 const Options& nominal);
  /// The window's motions (III-A to III-F), started from what is remembered.
  Segmentation segment(const Window& window, const StereoCamera& camera, const Options& options,
                       const Deadline& deadline) const;
  /// From here on these are the last window's motions; their labels have ids.
  void remember(const Window& window, Segmentation segmentation);

  const std::vector<KnownLabel>& labels() const { return labels_; }
  /// Index into labels() of each tracklet that one of them holds.
  const TrackletMap<int>& labelOf() const { return label_of_; }

 private:
  std::vector<int> assignment(const Window& window) const;

  std::vector<KnownLabel> labels_;
  TrackletMap<int> label_of_;
  double typical_residual_ = 0;  // of all labelled tracklets [px]
  std::shared_ptr<BatchMemory> memory_ = std::make_shared<BatchMemory>();
};

}  // namespace mvo
