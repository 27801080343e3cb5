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

/// A point at an offset q = (x, y) from the principal point is seen at
/// q (1 + radial r^2) + tangential (r^2 + 2 x^2, 2 x y), r = |q|. [px]
struct Distortion {
  double radial = 0;      ///< [1 / px^2]
  double tangential = 0;  ///< [1 / px]

  bool bends() const { return radial != 0 || tangential != 0; }
};

struct Eye {
  Side side = Side::kLeft;
  Eigen::Isometry3d T_eye_camera = Eigen::Isometry3d::Identity();  ///< camera: left optical
  StereoCamera lens;  ///< the pinhole before distortion; its baseline has no meaning
  Distortion distortion;
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
