// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The multimotion engine (III-A to III-F): a window of tracklets in, every rigid motion in it out.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mvo/deadline.hpp"
#include "mvo/estimate.hpp"
#include "mvo/label_estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A label of the last window.
struct KnownLabel {
  LabelId id = kOutlier;
  Trajectory trajectory;  ///< up to the last window's newest frame, or carried on to this one's
  LandmarkMap landmarks;  ///< may be empty
};

class BatchMemory;

/// What the last window knows about this one; default-constructed for a cold start.
struct WarmStart {
  std::vector<KnownLabel> labels;
  std::vector<int> assignment;  ///< per tracklet of the window: index into labels or kOutlier
  double typical_residual = 0;  ///< as the last window measured it [px]; 0 = unknown
  std::shared_ptr<BatchMemory> memory;  ///< that the batches work in; none: its own
};

/// The motions of a window. `estimates` runs parallel to `labeling.labels`; none where the batch
/// failed.
struct Segmentation {
  Labeling labeling;
  std::vector<std::optional<LabelEstimate>> estimates;
  double typical_residual = 0;  ///< median rho before the dead zone in the largest label [px]
  int rounds = 0;
  bool converged = false;  ///< the labels settled and nothing was cut short
  CutShort cut_short;
  std::vector<std::pair<std::string, double>> timings_ms;
};

/// Takes a window from any sensor's tracklets. Deterministic without a deadline. With one, the
/// first round is always done, so that every label has its tracklets, new motions are found, and
/// each motion has a pose; once it has passed, proposals stay as they were found, no further round
/// begins, and batches end with the poses that they were started from.
Segmentation segmentMotions(const Window& window, const StereoCamera& camera,
                            const WarmStart& start, const Options& options,
                            const Deadline& deadline = {});

/// The paper's comparison (Torr): the dominant motion is found and its tracklets removed until too
/// few are left.
Segmentation sequentialRansac(const Window& window, const StereoCamera& camera,
                              const Options& options);

}  // namespace mvo
