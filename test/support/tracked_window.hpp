// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The front end alone, without what the engine would tell it: points are expected to move on as
// they did.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "frontend/feature_tracker.hpp"
#include "frontend/tracklet_window.hpp"
#include "mvo/frame.hpp"
#include "mvo/options.hpp"

namespace mvo::test {

/// The points of a frame that is prepared first.
inline std::vector<Feature> trackFrame(FeatureTracker& tracker, const Frame& frame,
                                       const TrackingPrior& prior, const StereoCamera& camera,
                                       const FrontendOptions& options) {
  return tracker.track(std::move(*prepareFrame(frame, camera, options).images), prior, camera,
                       options);
}

/// A tracker and its window, frame by frame.
class TrackedWindow {
 public:
  TrackedWindow(const StereoCamera& camera, const Options& options)
      : camera_(camera),
        options_(options.frontend),
        tracker_(options.window.max_gap),
        window_(options.window) {}

  void add(const Frame& frame) {
    const TrackingPrior expected = prior();
    last_.clear();
    for (const Feature& f : features_) last_[f.id] = f.y;
    features_ = trackFrame(tracker_, frame, expected, camera_, options_);
    window_.add(next_++, features_);
  }

  /// What is expected of the next frame.
  TrackingPrior prior() const {
    TrackingPrior prior;
    for (const Feature& f : features_)
      if (const auto before = last_.find(f.id); before != last_.end())
        prior.predicted[f.id] = 2 * f.y - before->second;
    return prior;
  }
  const FeatureTracker& tracker() const { return tracker_; }
  const Window& window() const { return window_.window(); }
  const std::vector<Feature>& features() const { return features_; }

 private:
  StereoCamera camera_;
  FrontendOptions options_;
  FeatureTracker tracker_;
  TrackletWindow window_;
  std::vector<Feature> features_;               // of the last frame
  std::map<TrackletId, Eigen::Vector3d> last_;  // where those of the frame before were
  FrameId next_ = 0;
};

inline std::size_t observationsIn(const Window& window) {
  std::size_t count = 0;
  for (const Tracklet& t : window.tracklets) count += t.observations.size();
  return count;
}

}  // namespace mvo::test
