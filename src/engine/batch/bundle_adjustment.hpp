// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: the batch estimate of one label's poses and landmarks in stereo pixel space.
#pragma once

#include <cstddef>
#include <vector>

#include "mvo/label_estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// One label's batch. Poses are of consecutive frames first_frame, first_frame + 1, ...; the first
/// is C_1 and held as it is (identity).
struct Batch {
  struct Landmark {
    TrackletId id = 0;
    /// Homogeneous (x, y, z, w), any scale; w -> 0 is infinitely far. Zero, or behind the camera
    /// that saw it: starts from its measurement.
    Eigen::Vector4d p_c1 = Eigen::Vector4d::UnitW();
    /// Increasing frames, within the span of the poses.
    std::vector<Observation> observations;
  };

  FrameId first_frame = 0;
  std::vector<Eigen::Isometry3d> T_ck_c1;  ///< operating point in, estimate out
  std::vector<Landmark> landmarks;         ///< operating point in, estimate out
};

/// A landmark of a batch whose observations are somewhere else, e.g. in a window's tracklet.
struct BatchTrack {
  Eigen::Vector4d p_c1;      ///< as Batch::Landmark::p_c1
  const Observation* begin;  ///< as Batch::Landmark::observations
  const Observation* end;
  bool is_known = false;  ///< p_c1 is an earlier batch's estimate
};

/// Minimises J over the batch in place. `iterations` (at least 1) bounds the steps. Never raises J.
/// Batches that are empty, not finite, rank-deficient (too few observations of a pose, or all on a
/// line; frames that no landmarks tie together) or that diverge return usable = false and stay as
/// they were. The result does not depend on the number of threads.
BatchSummary adjustBundle(Batch& batch, const StereoCamera& camera, const NoiseOptions& noise,
                          const BundleAdjustmentOptions& options, int iterations);
/// The same without copying observations. Keeps its working memory, one per thread. Without
/// covariances, which cost a step, a rank-deficient batch may go unnoticed.
BatchSummary adjustBundle(FrameId first_frame, std::vector<Eigen::Isometry3d>& T_ck_c1,
                          std::vector<BatchTrack>& tracks, const StereoCamera& camera,
                          const NoiseOptions& noise, const BundleAdjustmentOptions& options,
                          int iterations, bool wants_covariance = true);

/// Whether a batch of so many observations uses two threads by itself; smaller ones are better
/// estimated side by side.
constexpr bool isBatchSplit(std::size_t observations) { return observations >= 6000; }

}  // namespace mvo
