// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// III-B: the dominant motion between two frames from three-point samples.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/link_residual.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

struct FrameMotion {
  Eigen::Isometry3d T_b_a = Eigen::Isometry3d::Identity();
  std::vector<char> inlier;  ///< one per pair
  int inliers = 0;
};

/// The SE(3) motion with the largest support (count) or the least truncated residual (MSAC).
/// `guess` is tried first. None for fewer than three pairs or when no sample has three inliers.
/// Deterministic in the seed.
std::optional<FrameMotion> ransacMotion(
    const std::vector<StereoPair>& pairs, const LinkResidual& residual,
    const ProposalOptions& options, std::uint64_t seed,
    const std::optional<Eigen::Isometry3d>& guess = std::nullopt);

/// Gauss-Newton on the weighted residuals of the pairs with Cauchy's loss of width `scale` [px],
/// from `T_b_a`.
Eigen::Isometry3d refineMotion(const Eigen::Isometry3d& T_b_a, const std::vector<StereoPair>& pairs,
                               const std::vector<char>& use, const LinkResidual& residual,
                               double scale, int iterations);

}  // namespace mvo
