// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How well a motion is known since it was first seen: a window's batch says it since the window's
// first frame, but that frame's own error is there to stay.
#pragma once

#include <optional>

#include "mvo/types.hpp"

namespace mvo {

/// The covariance of a motion since its first frame. With P_1 that of the window's first frame and
/// S that of the window's motion, P_k = S + Ad(T_ck_c1) P_1 Ad(T_ck_c1)^T; when the window moves on
/// by a frame, its share S / (W - 1) of the W frames' error becomes part of P_1. All are of left
/// perturbations of poses in the camera (rho, phi) [m^2, m rad, rad^2].
class GrowingCovariance {
 public:
  /// Takes the newest window.
  void update(const Trajectory& trajectory, const Matrix6d& window);

  /// Goes on from a frame whose pose is known as well as this, whatever was before.
  void continueFrom(FrameId frame, const Matrix6d& covariance);

  /// In the newest frame.
  const Matrix6d& newest() const { return newest_; }

 private:
  void slideTo(FrameId first_frame);

  std::optional<FrameId> since_;          // C_1
  Matrix6d at_since_ = Matrix6d::Zero();  // P_1
  Trajectory trajectory_;                 // of the last window
  Matrix6d window_ = Matrix6d::Zero();    // S of it
  Matrix6d newest_ = Matrix6d::Zero();    // P_k
};

}  // namespace mvo
