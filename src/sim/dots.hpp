// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The dots of a projector that is fixed to the camera: they do not move with what they fall on.
#pragma once

#include <optional>
#include <vector>

#include "sim/eye.hpp"

namespace mvo::sim {

/// A dot as an eye sees it.
struct SeenDot {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double peak = 0;  ///< brightness of its middle [grey levels]
};

/// The dots of a scene in an eye, each at the time of its row; none for those that fall on nothing
/// or are hidden from the eye. `time` is that of the frame's stamp [s]. In every frame and eye the
/// same number is the same dot.
std::vector<std::optional<SeenDot>> seenDots(const Scene& scene, double time, const Eye& eye);

/// Adds the dots to what an eye sees; 32FC1.
void addDots(const Scene& scene, double time, const Eye& eye, cv::Mat& light);

}  // namespace mvo::sim
