// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#include "io/frame_clock.hpp"

#include <algorithm>
#include <utility>

#include "statistics.hpp"

namespace mvo {

namespace {

// A stamp may be off by this share of a period: half would be the nearest frame of any.
constexpr double kMatchPeriods = 0.3;

std::int64_t medianPeriod(const std::vector<std::int64_t>& stamps) {
  if (stamps.size() < 2) return 0;
  std::vector<std::int64_t> periods;
  for (std::size_t k = 1; k < stamps.size(); ++k) periods.push_back(stamps[k] - stamps[k - 1]);
  return median(std::move(periods));
}

}  // namespace

FrameClock::FrameClock(std::vector<std::int64_t> stamps_ns)
    : stamps_ns_(std::move(stamps_ns)),
      tolerance_ns_(static_cast<std::int64_t>(kMatchPeriods *
                                              static_cast<double>(medianPeriod(stamps_ns_)))) {}

std::optional<std::size_t> FrameClock::frameOf(std::int64_t stamp_ns) const {
  auto nearest = std::lower_bound(stamps_ns_.begin(), stamps_ns_.end(), stamp_ns);
  if (nearest == stamps_ns_.end() ||
      (nearest != stamps_ns_.begin() && stamp_ns - *std::prev(nearest) < *nearest - stamp_ns)) {
    if (nearest == stamps_ns_.begin()) return {};
    --nearest;
  }
  if (std::abs(*nearest - stamp_ns) > tolerance_ns_) return {};
  return static_cast<std::size_t>(nearest - stamps_ns_.begin());
}

FramePoses posesByFrame(const FrameClock& clock, const std::vector<StampedPose>& poses) {
  FramePoses by_frame(clock.frames());
  for (const StampedPose& pose : poses)
    if (const auto frame = clock.frameOf(pose.stamp_ns); frame && !by_frame[*frame])
      by_frame[*frame] = pose.T_world_body;
  return by_frame;
}

}  // namespace mvo
