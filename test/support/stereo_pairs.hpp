// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Pairs of measurements for the kernels that take links.
#pragma once

#include <Eigen/Geometry>
#include <random>
#include <vector>

#include "kernels/link_residual.hpp"
#include "mvo/se3.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo::test {

inline const StereoCamera kPairCamera{500, 510, 319.5, 239.5, 0.24, 640, 480};
inline const Eigen::Isometry3d kPairMotion =
    exp((Vector6d() << 0.08, -0.03, 0.1, 0.02, -0.03, 0.01).finished());

/// Near and far, displaced by up to a few thresholds; some behind the camera, some without
/// disparity.
inline std::vector<StereoPair> somePairs(int n) {
  std::mt19937 random(static_cast<unsigned>(n));
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<StereoPair> pairs;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d p(uniform(random), uniform(random), 4 + 3.5 * uniform(random));
    StereoPair pair{kPairCamera.project(p), kPairCamera.project(kPairMotion * p)};
    for (int c = 0; c < 3; ++c) pair.y_b(c) += 3 * uniform(random);
    if (i % 7 == 3) pair.y_a.z() = pair.y_a.x() + 1;
    if (i % 11 == 5) pair.y_a = kPairCamera.project({0.01, 0.02, 0.05});
    pairs.push_back(pair);
  }
  return pairs;
}

}  // namespace mvo::test
