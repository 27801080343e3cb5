// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Estimates and truth on one clock: everything is scored by the index of the true frame.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <vector>

#include "mvo/io/labels_csv.hpp"
#include "mvo/io/tum.hpp"

namespace mvo {

/// A pose for each frame that has one.
using FramePoses = std::vector<std::optional<Eigen::Isometry3d>>;

/// The stamps of all frames, and which of them a stamp means.
class FrameClock {
 public:
  /// Stamps must increase.
  explicit FrameClock(std::vector<std::int64_t> stamps_ns);

  std::size_t frames() const { return stamps_ns_.size(); }
  /// The nearest frame, if it is within 0.3 frame periods (median distance of the stamps).
  std::optional<std::size_t> frameOf(std::int64_t stamp_ns) const;

 private:
  std::vector<std::int64_t> stamps_ns_;
  std::int64_t tolerance_ns_ = 0;
};

/// Poses by frame; those that belong to no frame are left out, of two in one frame the first
/// counts.
FramePoses posesByFrame(const FrameClock& clock, const std::vector<StampedPose>& poses);

/// Labels by frame; those that belong to no frame are left out.
std::vector<std::vector<LabelRow>> labelsByFrame(const FrameClock& clock,
                                                 const std::vector<LabelRow>& labels);

/// Length of the line through the positions [m].
double pathLength(const FramePoses& poses);

}  // namespace mvo
