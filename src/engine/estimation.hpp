// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: from a label's hypothesis and support to its batch estimate.
#pragma once

#include <optional>
#include <vector>

#include "mvo/label_estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// What a label's batch starts from beside the hypothesis.
struct BatchStart {
  const LandmarkMap* landmarks = nullptr;  ///< where known
  int iterations = 0;                      ///< at most
  bool wants_covariance = true;            ///< without, the summary's stay zero
};

/// Estimates the newest connected run of frames in which the support constrains every pose. Starts
/// from the hypothesis and `start`. None if there is no such run of at least two frames or the
/// batch fails.
std::optional<LabelEstimate> estimateLabel(const Window& window, const StereoCamera& camera,
                                           const Trajectory& hypothesis,
                                           const std::vector<int>& support, const BatchStart& start,
                                           const NoiseOptions& noise,
                                           const BundleAdjustmentOptions& options);

/// The same of all labels, side by side but for those whose batch is split in itself; starts and
/// estimates run parallel to the labels.
std::vector<std::optional<LabelEstimate>> estimateLabels(const Window& window,
                                                         const StereoCamera& camera,
                                                         const Labeling& labels,
                                                         const std::vector<BatchStart>& starts,
                                                         const NoiseOptions& noise,
                                                         const BundleAdjustmentOptions& options);

}  // namespace mvo
