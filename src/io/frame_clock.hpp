// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One clock for what was recorded at about the same time: everything is told by the index of the
// frame.
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mvo/trajectory_files.hpp"

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

}  // namespace mvo
