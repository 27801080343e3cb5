// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-F: the batch estimate of one label's poses and landmarks in stereo pixel space.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "mvo/label_estimate.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A landmark of a batch: its observations lie somewhere else, e.g. in a window's tracklet.
struct BatchTrack {
  /// Homogeneous (x, y, z, w) in C_1, any scale; w -> 0 is infinitely far. Zero, or behind the
  /// camera that saw it: starts from its measurement.
  Eigen::Vector4d p_c1;
  /// Increasing frames, within the span of the poses.
  const Observation* begin;
  const Observation* end;
  bool is_known = false;  ///< p_c1 is an earlier batch's estimate
};

/// One label's batch: operating point in, estimate out.
struct Bundle {
  FrameId first_frame = 0;
  /// Of consecutive frames first_frame, first_frame + 1, ...; the first is C_1 and held as it is
  /// (identity).
  std::vector<Eigen::Isometry3d> T_ck_c1;
  std::vector<BatchTrack> tracks;
};

/// How far a batch may go.
struct BatchEffort {
  int iterations = 0;  ///< steps at most, at least 1
  bool wants_covariance =
      true;  ///< a step's work; without, a rank-deficient batch may go unnoticed
};

/// Storage that batches work in. Whoever keeps it from window to window spares most of a batch's
/// time, which would go into fresh pages; batches side by side each borrow a piece.
class BatchMemory {
 public:
  BatchMemory();
  ~BatchMemory();

 private:
  friend class BundleAdjuster;
  struct Piece;
  std::unique_ptr<Piece> borrow();
  void giveBack(std::unique_ptr<Piece> piece);

  std::mutex mutex_;
  std::vector<std::unique_ptr<Piece>> spare_;
};

/// Adjusts one batch after another in the same piece of memory.
class BundleAdjuster {
 public:
  /// The memory must outlive the adjuster.
  BundleAdjuster(const StereoCamera& camera, const NoiseOptions& noise,
                 const BundleAdjustmentOptions& options, BatchMemory& memory);
  ~BundleAdjuster();
  BundleAdjuster(const BundleAdjuster&) = delete;
  BundleAdjuster& operator=(const BundleAdjuster&) = delete;

  /// Minimises J over the bundle in place. Never raises J. Bundles that are empty, not finite,
  /// rank-deficient (too few observations of a pose, or all on a line; frames that no landmarks tie
  /// together) or that diverge return usable = false and stay as they were. The result does not
  /// depend on the number of threads.
  BatchSummary adjust(Bundle& bundle, const BatchEffort& effort);
  /// The newest frame whose observations do not constrain its pose: too few, or all on a line.
  std::optional<FrameId> newestWeakFrame(const Bundle& bundle) const;

 private:
  StereoCamera camera_;
  NoiseOptions noise_;
  BundleAdjustmentOptions options_;
  BatchMemory& memory_;
  std::unique_ptr<BatchMemory::Piece> piece_;
};

/// Whether a batch of so many observations uses two threads by itself; smaller ones are better
/// estimated side by side.
constexpr bool isBatchSplit(std::size_t observations) { return observations >= 6000; }

}  // namespace mvo
