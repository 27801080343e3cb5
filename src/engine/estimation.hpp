// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: from a label's hypothesis and support to its batch estimate.
#pragma once

#include <optional>
#include <vector>

#include "engine/batch/bundle_adjustment.hpp"
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

/// Estimates, for each label, the newest connected run of frames in which its support constrains
/// every pose. Starts from the hypothesis and the label's start; none if there is no such run of at
/// least two frames or the batch fails. Labels are estimated side by side but for those whose batch
/// is split in itself; starts and estimates run parallel to the labels.
std::vector<std::optional<LabelEstimate>> estimateLabels(
    const Window& window, const StereoCamera& camera, const Labeling& labels,
    const std::vector<BatchStart>& starts, const NoiseOptions& noise,
    const BundleAdjustmentOptions& options, BatchMemory& memory);

}  // namespace mvo
