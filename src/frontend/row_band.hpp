// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "frontend/features.hpp"
#include "mvo/options.hpp"
#include "mvo/stereo_camera.hpp"

namespace mvo {

/// Where a point's row in the right image may be, below that in the left one [px].
struct RowBand {
  float middle = 0;
  float reach = 0;
};

/// The same row within frontend.max_epipolar; if the pair's errors are being learnt, where they put
/// it, within two standard deviations more. `y` is (u_l, v, u_r) [px].
RowBand expectedRows(const Eigen::Vector3d& y, const TrackingPrior& prior,
                     const StereoCamera& camera, const FrontendOptions& options);

}  // namespace mvo
