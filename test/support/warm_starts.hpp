// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What one window's motions tell the next one, as odometry passes it on.
#pragma once

#include <map>
#include <utility>

#include "engine/batch/bundle_adjustment.hpp"
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
    remember(window, segmentation.labeling);
    last_.typical_residual = segmentation.typical_residual;
    for (std::size_t l = 0; l < last_.labels.size(); ++l)
      if (const auto& estimate = segmentation.estimates[l]) {
        last_.labels[l].trajectory = estimate->trajectory;
        last_.labels[l].landmarks = estimate->landmarks;
      }
  }
  /// The same without landmarks.
  void remember(const Window& window, const Labeling& labeling) {
    last_.labels.clear();
    last_.typical_residual = 0;
    for (const Label& label : labeling.labels)
      last_.labels.push_back({label.id, label.trajectory, {}});
    label_of_.clear();
    for (std::size_t p = 0; p < labeling.assignment.size(); ++p)
      if (labeling.assignment[p] != kOutlier)
        label_of_[window.tracklets[p].id] = labeling.assignment[p];
  }

 private:
  WarmStart last_{{}, {}, 0, std::make_shared<BatchMemory>()};  // but for the assignment
  std::map<TrackletId, int> label_of_;
};

}  // namespace mvo::test
