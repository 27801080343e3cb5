// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What the batch of III-F knows about one label.
#pragma once

#include "mvo/tracklet_map.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// Landmarks by tracklet, homogeneous, in the camera of some frame.
struct LandmarkMap {
  FrameId frame = 0;
  TrackletMap<Eigen::Vector4d> p_c;
};

/// What the batch says about itself.
struct BatchSummary {
  bool usable = false;     ///< the solution may be used: finite, and every pose constrained
  bool converged = false;  ///< by tolerance, not by the iteration limit
  int iterations = 0;
  double initial_cost = 0;  ///< J, robustified
  double final_cost = 0;    ///< J, robustified
  double rms = 0;           ///< of the whitened residuals, unitless (1 = as noisy as R_jk says)
  double noise = 0;         ///< of the measurements, in R_jk's standard deviations; robust
  /// Of the newest pose's left perturbation (rho, phi) [m^2, m rad, rad^2] with C_1 held, landmarks
  /// and the other poses marginalised, for measurements as noisy as they were found to be.
  Matrix6d covariance = Matrix6d::Zero();
  /// The same of the newest step T_ck_ckm1, from the joint covariance of both poses.
  Matrix6d step_covariance = Matrix6d::Zero();
};

/// A label's batch estimate: connected poses, landmarks in C_1, and how well it went.
struct LabelEstimate {
  Trajectory trajectory;
  LandmarkMap landmarks;
  BatchSummary summary;
};

}  // namespace mvo
