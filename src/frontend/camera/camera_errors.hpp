// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The stereo pair's own error, found out while frames go by: rows that differ show a part of it at
// once; disparities that are wrong show when the camera moves, because near and far points of one
// rigid world agree on a motion only where depths are right.
#pragma once

#include <optional>
#include <vector>

#include "frontend/camera/error_field.hpp"
#include "frontend/features.hpp"
#include "frontend/tracklet_window.hpp"
#include "kernels/link_residual.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A Gaussian over the numbers of the error's fields that learns from each frame and slowly
/// forgets. Deterministic.
class CameraErrors {
 public:
  explicit CameraErrors(const StereoCamera& camera);

  /// Replaces what was learnt by what was known before, to be forgotten like it.
  void startFrom(const ErrorEstimate& known);
  /// `frames` are remembered at least.
  void addFrame(FrameId frame, double time, int frames);
  /// From the rows v_r - v_l of the newest frame's points, which the window must hold already.
  void learnRows(const std::vector<Feature>& features, const TrackletWindow& window);
  /// From pairs of frames that end at the newest one. `corrected` is the window as corrected() by
  /// the present estimate; the tracklets of `world` are thought to rest but may be wrong about it.
  void learnMotion(const Window& corrected, const Trajectory& trajectory,
                   const std::vector<int>& world, const LinkResidual& residual);

  const ErrorEstimate& estimate() const { return estimate_; }
  /// How the motion T_b_a of some tracklets, as it is estimated, moves with the numbers: a
  /// derivative of its left perturbation. None where too few are seen in both frames.
  std::optional<Eigen::Matrix<double, 6, kErrorTerms>> motionByErrors(
      const Window& corrected, FrameId a, FrameId b, const Eigen::Isometry3d& T_b_a,
      const std::vector<int>& tracklets, const LinkResidual& residual) const;
  /// The window as an exact pair would have seen it.
  Window corrected(const Window& seen) const;
  /// The same for one observation of a tracklet.
  Eigen::Vector3d corrected(const Tracklet& seen, std::size_t observation) const;

 private:
  // A Gaussian's exponent in the numbers: information and information * mean.
  struct Evidence {
    ErrorMatrix information = ErrorMatrix::Zero();
    ErrorVector vector = ErrorVector::Zero();
  };
  // A point seen in both frames of a pair.
  struct Row {
    Link link;                                       // as corrected now
    Eigen::Matrix<double, 3, kErrorTerms> by_error;  // derivative of its residual
    double share = 1;                                // of its information that is new
  };
  std::vector<Row> rowsOf(const Window& corrected, FrameId a, FrameId b,
                          const Eigen::Isometry3d& T_b_a, const std::vector<int>& world,
                          const LinkResidual& residual) const;
  std::optional<Evidence> evidenceOf(const std::vector<Row>& rows) const;
  ErrorEstimate solved(const Evidence& more) const;
  void add(const Evidence& more);
  Eigen::Vector2d velocityOf(const Tracklet& tracklet, std::size_t observation) const;

  StereoCamera camera_;
  double timeOf(FrameId frame) const { return clock_[static_cast<std::size_t>(frame - first_)]; }

  std::vector<double> clock_;  // stamps of frames first_, first_ + 1, ... [s]
  FrameId first_ = 0;
  int frames_ = 0;  // so far
  Evidence prior_;
  Evidence learnt_;
  ErrorEstimate estimate_;
};

}  // namespace mvo
