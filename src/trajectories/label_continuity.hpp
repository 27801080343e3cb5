// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Identity of labels from one window to the next, and which of them is the static world (III-G).
#pragma once

#include <set>
#include <vector>

#include "mvo/options.hpp"
#include "mvo/tracklet_map.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Remembers the id under which each tracklet of the window was last known.
class LabelContinuity {
 public:
  /// An id per label: matched one-to-one by shared tracklets, the larger part keeping the id at a
  /// split. Exactly one label (the static world, unless there are no labels) gets kStatic: the one
  /// that continues it, or by support where there is none or it is outgrown by
  /// options.static_hysteresis. A body that rested among the static tracklets gets its id back. New
  /// ids are fresh.
  std::vector<LabelId> assign(const Window& window, const Labeling& labels,
                              const TrajectoryOptions& options,
                              const std::vector<char>& alive = {});

  /// The bodies at rest: ids that most of their tracklets seen in the window's last frame, and at
  /// least three, have left for the static world.
  std::vector<LabelId> resting(const Window& window) const;

  /// The ids that a label may still get back.
  std::set<LabelId> remembered() const;

  /// A tracklet that goes on under another name.
  void rename(TrackletId from, TrackletId to);

 private:
  struct Past {
    LabelId last = kOutlier;   // in the last window
    LabelId moved = kOutlier;  // the last body it belonged to
  };

  TrackletMap<Past> past_;
  LabelId next_ = kStatic + 1;
};

}  // namespace mvo
