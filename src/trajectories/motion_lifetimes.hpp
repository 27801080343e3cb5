// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// When ids come, rest and go.
#pragma once

#include <map>
#include <vector>

#include "mvo/estimate.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Remembers each id's first and newest pose for as long as it may return.
class MotionLifetimes {
 public:
  /// Sets state and birth_frame of the frame's motions. Returns the ids without a pose now: those
  /// of `resting` as stopped, in every frame; others as lost, once. Ids last seen before
  /// `oldest_frame` that do not rest are forgotten.
  std::vector<DepartedMotion> update(FrameId frame, FrameId oldest_frame,
                                     const std::vector<LabelId>& resting,
                                     std::vector<MotionEstimate>& motions);

 private:
  std::map<LabelId, DepartedMotion> known_;
};

}  // namespace mvo
