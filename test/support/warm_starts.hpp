// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What one window's motions tell the next one, as odometry passes it on.
#pragma once

#include <map>
#include <utility>

#include "mvo/segment_motions.hpp"

namespace mvo::test {

class WarmStarts {
 public:
  /// What the last window knows about this one; nothing before the first.
  WarmStart startOf(const Window& window) const {
    WarmStart start = last_;
    start.assignment.clear();
    for (const Tracklet& t : window.tracklets) {
      const auto known = label_of_.find(t.id);
      start.assignment.push_back(known == label_of_.end() ? kOutlier : known->second);
    }
    return start;
  }

  /// The motions of a window, as they were found.
  void remember(const Window& window, const Segmentation& segmentation) {
    const Labeling& labeling = segmentation.labeling;
    remember(window, labeling);
    last_.typical_residual = segmentation.typical_residual;
    for (std::size_t l = 0; l < labeling.labels.size(); ++l) {
      const auto& estimate = segmentation.estimates[l];
      if (estimate) last_.labels[l].trajectory = estimate->trajectory;
      last_.landmarks.push_back(estimate ? estimate->landmarks : LandmarkMap{});
    }
  }
  /// The same without landmarks.
  void remember(const Window& window, const Labeling& labeling) {
    last_ = {};
    last_.labels = labeling.labels;
    label_of_.clear();
    for (std::size_t p = 0; p < labeling.assignment.size(); ++p)
      if (labeling.assignment[p] != kOutlier)
        label_of_[window.tracklets[p].id] = labeling.assignment[p];
  }

 private:
  WarmStart last_;  // but for the assignment
  std::map<TrackletId, int> label_of_;
};

}  // namespace mvo::test
