// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Identity of labels from one window to the next (III-G).
#pragma once

#include <optional>
#include <set>
#include <vector>

#include "mvo/tracklet_map.hpp"
#include "mvo/types.hpp"
#include "trajectories/static_world.hpp"

namespace mvo {

/// Remembers the id under which each tracklet of the window was last known.
class LabelContinuity {
 public:
  /// What is known of each label's tracklets. `evidence` has an entry per label, or none.
  std::vector<WorldCandidate> candidates(const Window& window, const Labeling& labels,
                                         const std::vector<WorldEvidence>& evidence) const;

  /// An id per label: matched one-to-one by shared tracklets, the larger part keeping the id at a
  /// split. The label `world`, if there is one, gets kStatic and no other does. A body that rested
  /// among the static tracklets gets its id back. New ids are fresh; a label without tracklets has
  /// none.
  std::vector<LabelId> assign(const Window& window, const Labeling& labels,
                              std::optional<int> world);

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
    LabelId home = kOutlier;   // in the last window in which it had a label
    LabelId moved = kOutlier;  // the last body it belonged to
  };

  Past pastOf(TrackletId id) const;

  TrackletMap<Past> past_;
  LabelId next_ = kStatic + 1;
};

}  // namespace mvo
