// SPDX-FileCopyrightText: 2026 the mvo authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Whether covariances tell the truth: normalised estimation errors squared (NEES).
#pragma once

#include <vector>

#include "io/frame_clock.hpp"
#include "mvo/evaluation.hpp"

namespace mvo {

/// Of the motions with one of some ids, by the span of their covariances; none without samples.
/// `T_ck_l` is the true pose in the camera of the body that they are of. Errors within one window
/// are correlated: of windows only those count that do not overlap.
Consistency consistencyOf(const FrameClock& clock, const std::vector<MotionCovariance>& rows,
                          const std::vector<int>& ids, const FramePoses& T_ck_l);

}  // namespace mvo
