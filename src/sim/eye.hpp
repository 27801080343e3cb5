// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// One eye of the pair as it is, not as the calibration says: where it looks, when, and through
// which lens.
#pragma once

#include <cstdint>

#include "mvo/sim.hpp"

namespace mvo::sim {

enum class Side : std::uint64_t { kLeft = 0, kRight = 1 };

struct Eye {
  Side side = Side::kLeft;
  Eigen::Isometry3d T_eye_camera = Eigen::Isometry3d::Identity();  ///< camera: left optical
  StereoCamera lens;   ///< the pinhole before distortion; its baseline has no meaning
  double radial = 0;   ///< a point at radius r is seen at r (1 + radial r^2) [1 / px^2]
  double delay = 0;    ///< of its exposure after the frame's stamp [s]
  double readout = 0;  ///< from its first to its last row [s]

  /// When a row is exposed, relative to the frame's stamp; the middle of the image at `delay`. [s]
  double rowTime(double row) const;
  /// Where a point of the eye's frame [m] is seen [px]. Needs p.z > 0.
  Eigen::Vector2d project(const Eigen::Vector3d& p) const;
  /// Where a pixel would be seen without distortion [px].
  Eigen::Vector2d undistort(const Eigen::Vector2d& pixel) const;
};

/// The left eye is as the calibration says, except for its readout.
Eye leftEye(const Scene& scene);
Eye rightEye(const Scene& scene);

}  // namespace mvo::sim
