// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Trajectories with a pose in every frame, for tests of figures.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "eval/frames.hpp"

namespace mvo::test {

/// A transform from its translation [m] and its rotation vector [rad].
inline Eigen::Isometry3d transform(double x, double y, double z, double rx = 0, double ry = 0,
                                   double rz = 0) {
  const Eigen::Vector3d phi(rx, ry, rz);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  if (phi.norm() > 0) T.linear() = Eigen::AngleAxisd(phi.norm(), phi.normalized()).matrix();
  T.translation() << x, y, z;
  return T;
}

/// A camera that sways and turns about all axes, 0.1 s per frame.
inline FramePoses handheld(int frames) {
  FramePoses poses;
  for (int k = 0; k < frames; ++k) {
    const double t = 0.1 * k;
    poses.emplace_back(transform(0.5 * std::sin(t), 0.3 * std::cos(1.3 * t), 0.2 * t,
                                 0.2 * std::sin(1.7 * t), 0.3 * std::sin(0.9 * t), 0.1 * t));
  }
  return poses;
}

/// The same trajectory with stamps `period_ns` apart, from `start_ns` on.
inline std::vector<StampedPose> stamped(const FramePoses& poses, std::int64_t start_ns,
                                        std::int64_t period_ns) {
  std::vector<StampedPose> result;
  for (std::size_t k = 0; k < poses.size(); ++k)
    if (poses[k])
      result.push_back({start_ns + static_cast<std::int64_t>(k) * period_ns, *poses[k]});
  return result;
}

}  // namespace mvo::test
