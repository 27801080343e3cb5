// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// How wrong it is to go on with a twist: tested on what has been.
#pragma once

#include <cstdint>
#include <deque>

#include "mvo/options.hpp"
#include "mvo/types.hpp"

namespace mvo {

/// A camera whose pose is not seen keeps its twist for a while and then stands.
Eigen::Isometry3d predictedMotion(const Vector6d& twist, double seconds,
                                  const TrajectoryOptions& options);

/// Remembers the last poses and twists.
class PredictionErrors {
 public:
  /// A pose that was estimated, and its twist in the camera's axes [m/s, rad/s].
  void add(std::int64_t stamp_ns, const Eigen::Isometry3d& T_world_ck, const Vector6d& twist);

  /// Second moments of log(T_predicted^-1 T_true) [m^2, m rad, rad^2] after so many seconds: those
  /// of all poses that are remembered, and, as if it had been seen once in so long a time, what
  /// options' accelerations allow, three standard deviations of it.
  Matrix6d covariance(double seconds, const TrajectoryOptions& options) const;

 private:
  struct Past {
    std::int64_t stamp_ns;
    Eigen::Isometry3d T_world_ck;
    Vector6d twist;
  };
  std::deque<Past> past_;
};

}  // namespace mvo
