// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The sliding window of tracklets (III): links go in, tracklets of the last K frames come out.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "frontend/features.hpp"
#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Owns the last K frames of observations. Tracklets that left the image stay until their last
/// frame leaves the window; gaps are kept as gaps. A tracklet enters the window with its second
/// observation.
class TrackletWindow {
 public:
  explicit TrackletWindow(const WindowOptions& options) : options_(options) {}

  /// Adds the next frame's points and drops the frames that are too old.
  void add(FrameId frame, const std::vector<Feature>& features);
  const Window& window() const { return window_; }

  /// Index of a tracklet in window().tracklets; none if it is not there.
  std::optional<int> find(TrackletId id) const;
  /// The tracklet that a point of the front end currently extends.
  TrackletId trackletOf(TrackletId feature) const;
  /// Of those points that extend a tracklet of the window: which, in the points' order.
  std::vector<SeenTracklet> seenTracklets(const std::vector<Feature>& features) const;
  /// Ends a tracklet before its newest observation, which starts a tracklet of its own: the link
  /// between them was wrong or marks a change of motion. Returns the new tracklet's id.
  TrackletId cut(TrackletId tracklet);

 private:
  // The tracklet that a point extends, where it has been cut.
  struct Alias {
    TrackletId tracklet = 0;
    FrameId last_seen = 0;
  };

  WindowOptions options_;
  Window window_;
  std::map<TrackletId, Tracklet> newborn_;  // a single observation so far
  std::map<TrackletId, Alias> of_feature_;  // points that may still be seen again
  TrackletId next_cut_ = TrackletId{1}
                         << 40;  // ids of cut tracklets never meet those of the front end
};

}  // namespace mvo
